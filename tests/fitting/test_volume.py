"""The model as solid and empty cells."""

import numpy as np
import pytest
from fitting_surfaces import block, subdivided, surface

from popsim.errors import MeshError
from popsim.fitting import Volume, measure_volume
from popsim.geometry.surface import Surface
from popsim.rendering.ray_scene import RayScene


def volume_of(shape: Surface) -> Volume:
    return measure_volume(RayScene(shape), shape.bounds, cells=96)


def test_block_is_solid_throughout_and_nothing_else_is() -> None:
    volume = volume_of(surface(block((-48, -24, 0), (48, 24, 30))))
    assert volume.cell == pytest.approx(1.0)
    assert volume.shape == (96, 24, 30)
    assert volume.solid.all()


def test_gap_under_a_table_is_empty() -> None:
    legs = [block((x, -20, 0), (x + 4, 20, 20)) for x in (-48, 44)]
    volume = volume_of(surface(block((-48, -20, 20), (48, 20, 24)), *legs))
    assert volume.solid[..., 20:].all()
    assert not volume.solid[:, 10:-10, :, :18].any()


def test_asymmetric_model_differs_between_the_halves() -> None:
    volume = volume_of(surface(block((-48, -20, 0), (48, 20, 10)), block((-48, 0, 10), (48, 20, 30))))
    assert volume.solid[0, :, :, 15:].all()
    assert not volume.solid[1, :, :, 15:].any()


def test_tessellation_does_not_matter() -> None:
    coarse = block((-48, -24, 0), (48, 24, 30))
    one = volume_of(surface(coarse))
    two = volume_of(surface(subdivided(coarse, 5)))
    assert np.array_equal(one.solid, two.solid)


def test_open_box_without_roof_and_floor_still_has_walls_that_hide_its_inside_from_the_sides() -> None:
    walls = block((-48, -24, 0), (48, 24, 30))
    sides = walls[np.abs(np.cross(walls[:, 1] - walls[:, 0], walls[:, 2] - walls[:, 0])[:, 2]) < 1e-9]
    volume = volume_of(surface(sides))
    assert not volume.solid[:, 5:-5, :20].any()  # seen from above


def test_closing_fills_a_lattice() -> None:
    bars = [block((x, -10, 0), (x + 2, 10, 40)) for x in range(-48, 48, 8)]
    volume = volume_of(surface(*bars))
    assert volume.solid.mean() < 0.5
    assert volume.closed(4).solid[:, 6:-6, :6, 8:-8].all()


def test_a_point_has_no_volume() -> None:
    dot = surface(block((0, 0, 0), (0, 0, 0)))
    with pytest.raises(MeshError, match="single point"):
        measure_volume(RayScene(surface(block((0, 0, 0), (1, 1, 1)))), dot.bounds)

"""The robust box ignores strays, and is exact where there are none."""

import numpy as np
import pytest
import trimesh
from mesh_solids import boxes_mesh, surface_of, truck_mesh

from popsim.mesh.bounds import RobustBounds, robust_bounds
from popsim.mesh.sampling import sample_surface

BODY = ((-1, -2, 0), (1, 2, 3))
STRAY = ((40, 0, 0), (40.05, 0.05, 0.05))
ANTENNA = ((0, 0, 3), (0.02, 0.02, 5))


def bounds_of(mesh: trimesh.Trimesh, *, trim_thin: bool = False) -> RobustBounds:
    surface = surface_of(mesh)
    return robust_bounds(surface, sample_surface(surface, 2000, seed=0), trim_thin=trim_thin)


def test_exact_without_strays() -> None:
    mesh = truck_mesh()
    found = bounds_of(mesh)
    np.testing.assert_array_equal(found.bounds, mesh.bounds)
    assert found.left_out == ()


def test_far_and_tiny_part_is_left_out_and_reported() -> None:
    found = bounds_of(boxes_mesh([BODY, STRAY]))
    np.testing.assert_allclose(found.bounds, BODY)
    (part,) = found.left_out
    assert part.reason == "far"
    np.testing.assert_allclose(part.bounds, STRAY, atol=0.05)
    assert part.area_share == pytest.approx(6 * 0.05**2 / (2 * (8 + 6 + 12)), rel=1e-2)
    assert "far from the rest" in str(part)


def test_far_but_large_part_stays() -> None:
    mesh = boxes_mesh([BODY, ((10, 0, 0), (12, 2, 2))])
    np.testing.assert_allclose(bounds_of(mesh).bounds, mesh.bounds)


def test_tiny_but_near_part_stays() -> None:
    mesh = boxes_mesh([BODY, ((1.2, 0, 0), (1.25, 0.05, 0.05))])
    np.testing.assert_allclose(bounds_of(mesh).bounds, mesh.bounds)


def test_antenna_is_kept_unless_asked_for() -> None:
    mesh = boxes_mesh([BODY, ANTENNA])
    assert bounds_of(mesh).bounds[1, 2] == 5
    trimmed = bounds_of(mesh, trim_thin=True)
    assert trimmed.bounds[1, 2] == pytest.approx(3, abs=0.05)
    np.testing.assert_allclose(trimmed.bounds[0], BODY[0])
    (part,) = trimmed.left_out
    assert part.reason == "thin"
    assert part.bounds[1, 2] == 5
    assert part.area_share < 0.005


def test_trimming_leaves_solid_models_alone() -> None:
    mesh = truck_mesh()
    np.testing.assert_array_equal(bounds_of(mesh, trim_thin=True).bounds, mesh.bounds)

"""The robust box ignores strays, and is exact where there are none."""

import numpy as np
import pytest
import trimesh
from mesh_solids import boxes_mesh, surface_of, truck_mesh, turn

from popsim.mesh.bounds import RobustBounds, body_of
from popsim.mesh.sampling import sample_surface

BODY = ((-1, -2, 0), (1, 2, 3))
STRAY = ((40, 0, 0), (40.05, 0.05, 0.05))
ANTENNA = ((0, 0, 3), (0.02, 0.02, 5))


def bounds_of(mesh: trimesh.Trimesh) -> RobustBounds:
    surface = surface_of(mesh)
    return body_of(surface, sample_surface(surface, 2000, seed=0)).box(np.eye(3))


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


def test_long_antenna_is_cut_off_and_reported() -> None:
    trimmed = bounds_of(boxes_mesh([BODY, ANTENNA]))
    assert trimmed.bounds[1, 2] == pytest.approx(3, abs=0.05)
    np.testing.assert_allclose(trimmed.bounds[0], BODY[0])
    (part,) = trimmed.left_out
    assert part.reason == "thin"
    assert part.bounds[1, 2] == 5
    assert part.area_share < 0.005
    assert "a thin end" in str(part)


def test_short_antenna_counts() -> None:
    mesh = boxes_mesh([BODY, ((0, 0, 3), (0.02, 0.02, 3.5))])
    np.testing.assert_array_equal(bounds_of(mesh).bounds, mesh.bounds)


def test_thin_foot_is_never_cut_off() -> None:
    mesh = boxes_mesh([((-1, -2, 3), (1, 2, 5)), ((0, 0, 0), (0.02, 0.02, 3))])
    np.testing.assert_array_equal(bounds_of(mesh).bounds, mesh.bounds)


def test_wide_ends_count_however_little_of_the_area_they_have() -> None:
    inside = [((-0.9 + 0.1 * k, -1.9, 0.1), (-0.85 + 0.1 * k, 1.9, 1.9)) for k in range(18)]
    legs = [((x, y, 1.99), (x + 0.02, y + 0.02, 3)) for x in (-1.0, 0.98) for y in (-2.0, 1.98)]
    mesh = boxes_mesh([((-1, -2, 0), (1, 2, 2)), *inside, *legs])
    np.testing.assert_array_equal(bounds_of(mesh).bounds, mesh.bounds)


def test_trimming_leaves_solid_models_alone() -> None:
    mesh = truck_mesh()
    np.testing.assert_array_equal(bounds_of(mesh).bounds, mesh.bounds)


def test_box_in_a_turned_frame_is_exact() -> None:
    mesh = truck_mesh()
    surface = surface_of(mesh)
    rotation = turn(np.array([0.0, 0.0, 1.0]), 33)[:3, :3]
    found = body_of(surface, sample_surface(surface, 2000, seed=0)).box(rotation)
    turned = mesh.vertices @ rotation.T
    np.testing.assert_allclose(found.bounds, [turned.min(axis=0), turned.max(axis=0)], atol=1e-12)

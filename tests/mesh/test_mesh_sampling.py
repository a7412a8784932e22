"""Sample points depend on the surface, not on its triangles."""

import numpy as np
import pytest
import trimesh
from mesh_solids import surface_of
from scipy.spatial import cKDTree

from popsim.errors import GeometryError
from popsim.geometry.surface import Surface
from popsim.mesh.sampling import Samples, sample_surface

CENTROID_NOISE = 0.1
"""Root mean square distance of corresponding points, in spacings: probes are spread, not integrated."""


def apart(first: Samples, second: Samples) -> float:
    distance = cKDTree(first.points).query(second.points)[0] / first.spacing
    return float(np.sqrt(np.mean(distance**2)))


def subdivided(mesh: trimesh.Trimesh, faces: int) -> trimesh.Trimesh:
    while len(mesh.faces) < faces:
        mesh = mesh.subdivide()
    return mesh


def slivers(count: int) -> Surface:
    """The unit square as `2 count` slivers."""
    x = np.linspace(0, 1, count + 1)
    low, high = np.stack([x, 0 * x, 0 * x], axis=1), np.stack([x, 0 * x + 1, 0 * x], axis=1)
    triangles = np.concatenate(
        [np.stack([low[:-1], low[1:], high[1:]], axis=1), np.stack([low[:-1], high[1:], high[:-1]], axis=1)]
    )
    return Surface(
        triangles,
        np.zeros((2 * count, 3, 2)),
        np.zeros(2 * count, dtype=int),
        surface_of(trimesh.creation.box()).materials,
    )


def test_box_of_12_and_of_100000_triangles() -> None:
    coarse = trimesh.creation.box([1, 2, 3])
    fine = subdivided(coarse.copy(), 100_000)
    few, many = (sample_surface(surface_of(mesh), 2000, seed=0) for mesh in (coarse, fine))
    assert abs(len(few.points) - len(many.points)) <= 0.01 * len(few.points)
    assert apart(few, many) < CENTROID_NOISE
    assert apart(many, few) < CENTROID_NOISE


def test_square_of_2_and_of_4000_slivers() -> None:
    few, many = (sample_surface(slivers(count), 1000, seed=0) for count in (1, 2000))
    assert abs(len(few.points) - len(many.points)) <= 0.01 * len(few.points)
    assert apart(few, many) < CENTROID_NOISE


def test_negative_control_random_points_are_far_from_even() -> None:
    mesh = trimesh.creation.box([1, 2, 3])
    even = sample_surface(surface_of(mesh), 2000, seed=0)
    scattered, face = trimesh.sample.sample_surface(mesh, len(even.points), seed=0)
    random = Samples(scattered, mesh.face_normals[face], face, np.ones(len(face)), even.spacing)
    assert apart(random, even) > 4 * CENTROID_NOISE


@pytest.mark.parametrize("mesh", [trimesh.creation.box([1, 2, 3]), trimesh.creation.icosphere(3)])
def test_points_lie_on_their_faces_and_carry_the_area(mesh: trimesh.Trimesh) -> None:
    surface = surface_of(mesh)
    samples = sample_surface(surface, 1500, seed=3)
    np.testing.assert_allclose(samples.area.sum(), mesh.area, rtol=1e-9)
    corner = surface.triangles[samples.face, 0]
    np.testing.assert_allclose(np.einsum("ij,ij->i", samples.points - corner, samples.normals), 0, atol=1e-9)
    np.testing.assert_allclose(samples.normals, mesh.face_normals[samples.face], atol=1e-9)
    assert 0.7 * 1500 < len(samples.points) < 1.3 * 1500


def test_points_of_a_plane_are_a_grid_apart() -> None:
    samples = sample_surface(slivers(1), 900, seed=0)
    nearest = cKDTree(samples.points).query(samples.points, k=2)[0][:, 1] / samples.spacing
    assert np.median(nearest) == pytest.approx(1, abs=0.05)
    assert nearest.min() > 0.5


def test_area_is_spread_evenly() -> None:
    samples = sample_surface(surface_of(trimesh.creation.box([1, 1, 4])), 3000, seed=0)
    slabs = np.histogram(samples.points[:, 2], bins=8, range=(-2, 2), weights=samples.area)[0]
    np.testing.assert_allclose(slabs[1:-1], 4 * 0.5, rtol=0.12)


def test_same_seed_same_points_other_seed_other_grid() -> None:
    surface = surface_of(trimesh.creation.icosphere(2))
    first, again, other = (sample_surface(surface, 500, seed=seed) for seed in (1, 1, 2))
    assert first.points.tobytes() == again.points.tobytes()
    assert first.points.tobytes() != other.points.tobytes()


def test_opposite_sides_of_a_thin_sheet_stay_apart() -> None:
    samples = sample_surface(surface_of(trimesh.creation.box([1, 1, 1e-3])), 500, seed=0)
    assert samples.area[samples.normals[:, 2] > 0.9].sum() == pytest.approx(1)
    assert samples.area[samples.normals[:, 2] < -0.9].sum() == pytest.approx(1)


def test_faces_without_an_area_change_nothing() -> None:
    box = surface_of(trimesh.creation.box([1, 2, 3]))
    far, on = np.full((1, 3, 3), 7.0), np.array([[[0, 0, 1.5], [0.2, 0, 1.5], [0.4, 0, 1.5]]])
    line = np.array([[[4.0, 0, 0], [9, 0, 0], [5, 0, 0]]])
    corners = np.concatenate([far, box.triangles[:5], on, line, box.triangles[5:]])
    count = len(corners)
    mixed = Surface(corners, np.zeros((count, 3, 2)), np.zeros(count, dtype=int), box.materials)
    plain, samples = (sample_surface(surface, 500, seed=0) for surface in (box, mixed))
    np.testing.assert_array_equal(samples.points, plain.points)
    np.testing.assert_array_equal(samples.normals, plain.normals)
    np.testing.assert_array_equal(samples.area, plain.area)
    np.testing.assert_array_equal(corners[samples.face], box.triangles[plain.face])


def test_bad_requests() -> None:
    surface = surface_of(trimesh.creation.box())
    with pytest.raises(GeometryError, match="at least 1"):
        sample_surface(surface, 0, seed=0)
    flat = Surface(surface.triangles * 0, surface.uv, surface.material, surface.materials)
    with pytest.raises(GeometryError, match="without an area"):
        sample_surface(flat, 10, seed=0)

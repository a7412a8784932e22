"""Mirror planes are found wherever they are, and only where they are."""

import numpy as np
import pytest
import trimesh
from mesh_solids import TRUCK, boxes_mesh, shift, surface_of, truck_mesh

from popsim.geometry.arrays import FloatArray
from popsim.mesh.sampling import sample_surface
from popsim.mesh.symmetry import MirrorPlane, MirrorSearch

Y = np.array([0.0, 1.0, 0.0])


def best(mesh: trimesh.Trimesh, normal: FloatArray = Y) -> MirrorPlane:
    along = mesh.vertices @ normal
    search = MirrorSearch(sample_surface(surface_of(mesh), 2500, seed=0))
    return search.best_plane(normal, (float(along.min()), float(along.max())))


@pytest.mark.parametrize("offset", [0.0, 7.3, -100.0])
def test_plane_of_a_shifted_truck(offset: float) -> None:
    plane = best(truck_mesh().apply_transform(shift(1, offset, 2)))
    assert plane.score > 0.97
    assert plane.offset == pytest.approx(offset, abs=1e-6 + 1e-3)
    assert plane.centred


def test_plane_off_the_middle_of_the_box() -> None:
    # a thin mast on one side widens the box but hardly changes the shape
    mesh = boxes_mesh([*TRUCK, ((0, 3.0, 0), (0.1, 3.1, 0.5)), ((0, 1.0, 0.4), (0.1, 3.0, 0.5))])
    plane = best(mesh)
    assert mesh.bounds[:, 1].mean() == pytest.approx(1.0)
    assert plane.offset == pytest.approx(0.0, abs=0.02)
    assert not plane.centred
    assert plane.score > 0.9


def test_truck_is_not_symmetric_from_front_to_back() -> None:
    assert best(truck_mesh(), np.array([1.0, 0.0, 0.0])).score < 0.8


def test_scattered_triangles_are_not_symmetric() -> None:
    corners = np.random.default_rng(0).uniform(-1, 1, (150, 3, 3))
    soup = trimesh.Trimesh(corners.reshape(-1, 3), np.arange(450).reshape(-1, 3), process=False)
    assert best(soup).score < 0.6


@pytest.mark.parametrize("angle", [0.0, 0.7, 1.9])
def test_every_vertical_plane_mirrors_a_cylinder(angle: float) -> None:
    normal = np.array([np.cos(angle), np.sin(angle), 0])
    assert best(trimesh.creation.cylinder(1, 2, sections=128), normal).score > 0.95


def test_slanted_normal() -> None:
    normal = np.array([3.0, 4.0, 0.0]) / 5
    mesh = truck_mesh().apply_transform(trimesh.geometry.align_vectors(Y, normal))
    assert best(mesh, normal).score > 0.97
    assert best(mesh, Y).score < 0.9

"""Flat things that are alike on both sides stand on their edge, unless the user says otherwise."""

import numpy as np
import pytest
import trimesh
from mesh_solids import boxes_mesh, model_of, shift, truck_mesh, turn

from popsim.mesh.alignment import Alignment, align
from popsim.mesh.on_edge import FLAT

RING = trimesh.creation.annulus(40, 50, 8)
PLATE = trimesh.creation.box([100, 60, 5])


def sizes(found: Alignment) -> np.ndarray:
    """Extents in the canonical frame."""
    return np.ptp(found.box.bounds, axis=0)


def test_a_lying_ring_is_set_on_its_edge() -> None:
    found = align(model_of(RING))
    np.testing.assert_allclose(sizes(found), [100, 8, 100], rtol=0.02)
    assert "set on its edge; --up z lays it down" in found.reasons[0]
    assert found.up.confidence == 0.5


def test_a_plate_stands_on_its_longer_side() -> None:
    np.testing.assert_allclose(sizes(align(model_of(PLATE))), [100, 5, 60], rtol=0.02)


def test_it_stands_on_its_wider_foot() -> None:
    wide = boxes_mesh([((-50, -50, -3), (50, 0, 3)), ((-20, 0, -3), (20, 40, 3))])
    for matrix in (np.eye(4), turn(np.array([0.0, 0.0, 1.0]), 180)):
        found = align(model_of(wide, matrix))
        np.testing.assert_allclose(found.matrix[2, :3] @ matrix[:3, :3], [0, 1, 0], atol=0.02)


def test_askew_in_its_file_it_stands_all_the_same() -> None:
    matrix = shift(3, 2, 1) @ turn(np.array([1.0, 2.0, 0.5]), 25)
    found = align(model_of(PLATE, matrix))
    np.testing.assert_allclose(sizes(found), [100, 5, 60], rtol=0.02)
    told = found.reasons[0].split("--up ")[1].split(" lays")[0]
    np.testing.assert_allclose(sizes(align(model_of(PLATE, matrix), up=told)), [100, 60, 5], rtol=0.05)


@pytest.mark.parametrize("up", ["z", "0,0,1"])
def test_it_lies_where_the_user_says_so(up: str) -> None:
    np.testing.assert_allclose(sizes(align(model_of(RING), up=up)), [100, 100, 8], rtol=0.02)


def test_what_has_two_different_sides_lies() -> None:
    town = boxes_mesh([((-50, -50, 0), (50, 50, 3)), ((-30, -30, 3), (-10, -10, 12)), ((10, 0, 3), (30, 30, 9))])
    assert sizes(align(model_of(town)))[2] == pytest.approx(12, rel=0.02)


def test_what_is_not_flat_lies() -> None:
    thick = trimesh.creation.box([100, 60, 60 * FLAT * 1.1])
    assert "on its edge" not in align(model_of(thick)).reasons[0]
    assert "on its edge" not in align(model_of(truck_mesh())).reasons[0]

"""Planes, areas and distances."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.errors import GeometryError
from popsim.geometry.plane import Plane, area_vector, line_distance

RING = np.array([[0.0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]])
seeds = st.integers(0, 2**32 - 1)


def turned(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    matrix, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return matrix * np.sign(np.linalg.det(matrix)), rng.uniform(-300, 300, 3)


def test_area_vector_is_twice_the_area_along_the_normal() -> None:
    assert area_vector(RING) == pytest.approx([0, 0, 24])
    assert area_vector(RING[::-1]) == pytest.approx([0, 0, -24])


@given(seed=seeds)
@settings(max_examples=40, deadline=None)
def test_area_does_not_depend_on_the_place(seed: int) -> None:
    turn, shift = turned(seed)
    assert np.linalg.norm(area_vector(RING @ turn.T + shift)) == pytest.approx(24)


@given(seed=seeds)
@settings(max_examples=40, deadline=None)
def test_flat_and_lift_undo_each_other(seed: int) -> None:
    turn, shift = turned(seed)
    ring = RING @ turn.T + shift
    plane = Plane.through(ring)
    assert plane.lift(plane.flat(ring)) == pytest.approx(ring)
    assert plane.distance(ring) == pytest.approx(np.zeros(4), abs=1e-10)
    assert plane.distance(ring + 2.5 * plane.normal) == pytest.approx(np.full(4, 2.5))
    assert plane.polygon(ring).area == pytest.approx(12)
    assert plane.polygon(ring).exterior.is_ccw
    axes = np.array([plane.u, plane.v, plane.normal])
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)


@pytest.mark.parametrize(
    ("normal", "u", "v"),
    [
        ([0, 1, 0], [-1, 0, 0], [0, 0, 1]),
        ([1, 0, 0], [0, 1, 0], [0, 0, 1]),
        ([0, 0, 1], [1, 0, 0], [0, 1, 0]),
        ([0, 0, -1], [1, 0, 0], [0, -1, 0]),
    ],
)
def test_axes_are_level_and_upright(normal: list[float], u: list[float], v: list[float]) -> None:
    plane = Plane.facing(np.array(normal, float), np.zeros(3))
    assert plane.u == pytest.approx(u)
    assert plane.v == pytest.approx(v)
    assert plane.normal == pytest.approx(normal)


@pytest.mark.parametrize("ring", [RING[:2], RING[[0, 1, 0, 1]], np.zeros((4, 3)), np.zeros((0, 3))])
def test_ring_without_area_has_no_plane(ring: np.ndarray) -> None:
    with pytest.raises(GeometryError, match="encloses no area"):
        Plane.through(ring)


def test_holes_are_cut() -> None:
    plane = Plane.through(RING)
    hole = np.array([[1.0, 1, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0]])
    assert plane.polygon(RING, (hole,)).area == pytest.approx(11)


def test_distance_from_a_line() -> None:
    axis = np.array([[0.0, 0, 1], [5, 0, 1]])
    points = np.array([[100.0, 0, 1], [-3, 3, 5], [0, 0, 0]])
    assert line_distance(points, axis) == pytest.approx([0, 5, 1])


def test_planes_are_locked() -> None:
    plane = Plane.through(RING)
    with pytest.raises(ValueError, match="read-only"):
        plane.origin[0] = 1
    with pytest.raises(ValueError, match="read-only"):
        plane.normal[0] = 1

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import LineString, Polygon

from popsim.geometry.chords import chords, edges_of, shared

SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
HOLE = np.array([[4.0, 4.0], [4.0, 6.0], [6.0, 6.0], [6.0, 4.0]])


def test_a_line_over_an_area_with_a_hole():
    found = chords(edges_of([SQUARE, HOLE]), np.array([[-5.0, 5.0], [-4.0, 5.0]]))
    assert found == pytest.approx(np.array([[5.0, 9.0], [11.0, 15.0]]))


def test_a_line_beside_an_area_has_no_chord():
    assert chords(edges_of([SQUARE]), np.array([[0.0, 11.0], [1.0, 11.0]])).shape == (0, 2)


def test_a_line_along_an_edge_has_it_on_one_side_only():
    left = chords(edges_of([SQUARE]), np.array([[0.0, 0.0], [1.0, 0.0]]))
    right = chords(edges_of([SQUARE]), np.array([[1.0, 0.0], [0.0, 0.0]]))
    assert [len(left), len(right)] == [1, 0]


@given(seed=st.integers(0, 10_000))
def test_chords_are_what_an_overlay_finds(seed):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.random(9)) * 2 * np.pi
    ring = (5 + 20 * rng.random(9))[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    area = Polygon(ring)
    line = rng.normal(scale=10, size=(2, 2))
    along = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    found = chords(edges_of([ring]), line)
    if area.is_valid:
        overlay = area.intersection(LineString([line[0] - 1e3 * along, line[0] + 1e3 * along]))
        assert np.diff(found).sum() == pytest.approx(overlay.length, abs=1e-9)


def test_shared_stretches():
    one, other = np.array([[0.0, 4.0], [6.0, 9.0]]), np.array([[3.0, 7.0], [9.0, 12.0]])
    assert shared(one, other).tolist() == [[3.0, 4.0], [6.0, 7.0]]
    assert shared(one, np.zeros((0, 2))).shape == (0, 2)

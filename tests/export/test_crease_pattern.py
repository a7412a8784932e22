"""Crease patterns for simulators: each crease once, no slivers, whatever lies beside it."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from popsim.export.crease_pattern import APART, CUT, Edge, Triangles, triangles

MOUNTAIN, VALLEY = Edge("M", -45.0), Edge("V", 90.0)

SQUARE = shapely.box(0.0, 0.0, 60.0, 40.0)
ACROSS = shapely.LineString([(0, 20), (60, 20)])


def length(found: Triangles, *kinds: Edge) -> float:
    """Of the edges of these kinds at which two faces meet."""
    return sum(
        float(np.linalg.norm(found.corners[b] - found.corners[a]))
        for (a, b), what in found.edges.items()
        if what in kinds and faces_at(found).get(frozenset((a, b))) == 2
    )


def faces_at(found: Triangles) -> Counter[frozenset[int]]:
    return Counter(frozenset(pair) for face in found.faces.tolist() for pair in pairwise([*face, face[0]]))


def heights(found: Triangles) -> np.ndarray:
    one, two, three = (found.corners[found.faces[:, i]] for i in range(3))
    longest = np.max([np.linalg.norm(side, axis=1) for side in (two - one, three - two, one - three)], axis=0)
    (x, y), (u, v) = (two - one).T, (three - one).T
    return np.asarray((x * v - y * u) / longest)


def sound(found: Triangles) -> None:
    """Triangles counterclockwise, each edge at two of them at most, corners apart."""
    assert (heights(found) > 0.01).all()
    beside = faces_at(found)
    assert max(beside.values()) <= 2
    for pair in beside:
        assert np.linalg.norm(np.subtract(*found.corners[list(pair)])) > APART / 2
    named = {frozenset(edge) for edge in found.edges}
    assert {edge for edge, count in beside.items() if count == 1} <= named


@pytest.mark.parametrize(
    ("outline", "crease", "wanted"),
    [
        (SQUARE, ACROSS, 60.0),
        (SQUARE, shapely.LineString([(0.15, 20), (59.85, 20)]), 60.0),  # ends short of the border
        (SQUARE, shapely.LineString([(0.12, 0.1), (60, 40)]), 72.1),  # ends beside a corner
        (SQUARE, shapely.LineString([(-0.12, 20.1), (60.1, 19.9)]), 60.0),  # ends beyond it
        (SQUARE, shapely.LineString([(0.5, 0.02), (59.5, 0.02)]), 0.0),  # along the border: none is left
        # begins at a corner that lies just off its line
        (shapely.Polygon([(0, 0), (60, 0), (60, 40), (5, 40), (5, 20.08), (0, 19)]), ACROSS, 55.2),
        # along a notch narrower than corners are apart, which leaves a part of it
        (SQUARE.difference(shapely.box(-1.0, 20.0, 20.0, 20.1)), ACROSS, 40.0),
        (SQUARE.difference(shapely.box(20.0, 15.0, 40.0, 25.0)), ACROSS, 40.0),  # over a hole: in two parts
    ],
)
def test_a_crease_is_there_once(outline: shapely.Polygon, crease: shapely.LineString, wanted: float) -> None:
    found = triangles(outline, [(crease, VALLEY)], [])
    sound(found)
    assert length(found, VALLEY) == pytest.approx(wanted, abs=2 * APART)


def test_corners_stay_where_they_are_unless_they_are_close() -> None:
    shape = shapely.Polygon([(0.037, 0.011), (60.113, 0.4), (59.91, 40.77), (0.0, 40.0)])
    found = triangles(shape, [(shapely.LineString([(0.037, 0.011), (59.91, 40.77)]), MOUNTAIN)], [])
    assert len(found.faces) == 2
    for corner in shapely.get_coordinates(shape):
        assert np.linalg.norm(found.corners - corner, axis=1).min() < 1e-9


@pytest.mark.parametrize("beside", [0.0, 0.04])
def test_a_cut_as_near_to_a_crease_is_left_out(beside: float) -> None:
    cut = shapely.LineString([(0, 20 + beside), (25, 20 + beside)])
    found = triangles(SQUARE, [(ACROSS, VALLEY)], [cut])
    sound(found)
    assert length(found, VALLEY) == pytest.approx(60.0, abs=2 * APART)
    assert length(found, CUT) == 0.0


def test_cuts_have_a_corner_within() -> None:
    cut = shapely.LineString([(20, 0), (20, 30), (30, 30)])
    found = triangles(SQUARE, [(shapely.LineString([(30, 40), (30, 0)]), VALLEY)], [cut])
    assert length(found, CUT) == pytest.approx(40.0)
    assert sum(what == CUT for what in found.edges.values()) == 4


@given(
    ends=st.tuples(st.floats(0.0, 40.0), st.floats(0.0, 40.0)),
    teeth=st.lists(st.tuples(st.floats(1.0, 55.0), st.floats(0.05, 3.0), st.floats(0.05, 30.0)), max_size=4),
)
def test_what_is_enclosed_is_the_piece(ends: tuple[float, float], teeth: list[tuple[float, float, float]]) -> None:
    """Area and border to what corners are put together, with random notches and a crease across them."""
    notches = shapely.union_all([shapely.box(x, -1.0, x + wide, deep) for x, wide, deep in teeth])
    outline = max(shapely.get_parts(SQUARE.difference(notches)), key=lambda part: part.area)
    line = shapely.LineString([(0, ends[0]), (60, ends[1])])
    creases = [part for part in shapely.get_parts(line.intersection(outline)) if part.length > 2.0]
    found = triangles(outline, [(part, MOUNTAIN) for part in creases], [])
    whole = shapely.union_all(shapely.polygons(found.corners[found.faces]))
    assert abs(whole.area - outline.area) < APART * (outline.length + 1.0)
    assert length(found, MOUNTAIN) < sum(part.length for part in creases) + 4.0 * APART * len(creases)
    assert whole.difference(outline.buffer(2 * APART)).area < 1e-6

"""Rasters agree with asking for each pixel, holes and islands included."""

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate, translate
from shapely.geometry import MultiPolygon, Point, Polygon, box

from popsim.geometry.raster import covered

LOW, PIXEL, SIZE = np.array([-10.0, -7.0]), 0.37, (40, 61)


def asked(shape):
    """The same, one pixel after the other."""
    rows, columns = SIZE
    u = LOW[0] + (np.arange(columns) + 0.5) * PIXEL
    v = LOW[1] + (rows - np.arange(rows) - 0.5) * PIXEL
    return shapely.contains_xy(shape, *np.meshgrid(u, v))


@given(
    turn=st.floats(0, 90),
    shift=st.tuples(st.floats(-9, 9), st.floats(-9, 9)),
    hole=st.floats(0.5, 3),
    star=st.booleans(),
)
@settings(max_examples=50, deadline=None)
def test_pixels_are_covered_as_asked_one_by_one(turn, shift, hole, star):
    body = Polygon([(-6, -5), (0, -1), (6, -5), (3, 0), (6, 5), (-6, 5)]) if star else box(-6, -5, 6, 5)
    shape = translate(rotate(body, turn), *shift).difference(Point(shift).buffer(hole))
    shape = shapely.union(shape, Point(shift[0] + 12, shift[1]).buffer(2))
    found, expected = covered(shape, LOW, PIXEL, SIZE), asked(shape)
    rim = asked(shape.boundary.buffer(1e-6))  # on the line itself either is right
    assert found.shape == SIZE
    assert not ((found != expected) & ~rim).any()


def test_nothing_covers_nothing_and_everything_everything():
    assert not covered(Polygon(), LOW, PIXEL, SIZE).any()
    assert not covered(MultiPolygon(), LOW, PIXEL, SIZE).any()
    assert covered(box(-100, -100, 100, 100), LOW, PIXEL, SIZE).all()


def test_row_zero_is_the_upper_one():
    found = covered(box(-10, -7, 10, -6), LOW, PIXEL, SIZE)
    assert found[-1].sum() == 54 and not found[:-3].any()

"""Inked shapes are cut where a glass ends."""

import pytest
from shapely.geometry import LineString, MultiPolygon, Polygon, box

from popsim.booklet.inks import Ink
from popsim.booklet.shapes import Shape, clipped


def test_shapes_end_at_the_window() -> None:
    area, line = clipped(
        [Shape(Ink.PANEL, box(0, 0, 4, 4)), Shape(Ink.GLASS, LineString([(0, 1), (4, 1)]))], box(1, 0, 9, 2)
    )
    assert area.geometry.equals(box(1, 0, 4, 2))
    assert line.geometry.length == pytest.approx(3)


def test_knots_of_rounding_are_no_obstacle() -> None:
    """Areas that overlap by a hair, and one whose rim crosses itself, as magnifying leaves them."""
    overlapping = MultiPolygon([box(0, 0, 2, 2), box(2 - 1e-9, 0, 4, 2)])
    hair = 1e-9
    rim = [(0, 0), (4, 0), (4, 2), (2, 2), (2 + hair, 2 + hair), (2 + 2 * hair, 2), (2 - hair, 2), (0, 2)]
    for knotted in (overlapping, Polygon(rim)):
        assert not knotted.is_valid
        (found,) = clipped([Shape(Ink.PANEL, knotted)], box(1, 1, 3, 9))
        assert found.geometry.is_valid
        assert found.geometry.area == pytest.approx(2, abs=1e-6)

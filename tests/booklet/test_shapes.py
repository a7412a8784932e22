"""Inked shapes are cut where a glass ends."""

from types import SimpleNamespace

import numpy as np
import pytest
from shapely.geometry import LineString, MultiPolygon, Polygon, box

from popsim.booklet.inks import Ink
from popsim.booklet.scenery import Scenery
from popsim.booklet.shapes import Shape, clipped
from popsim.booklet.things import Kind
from popsim.layout import Face


def test_shapes_end_at_the_window() -> None:
    area, line = clipped(
        [Shape(Ink.PANEL, box(0, 0, 4, 4)), Shape(Ink.GLASS, LineString([(0, 1), (4, 1)]))], box(1, 0, 9, 2)
    )
    assert area.geometry.equals(box(1, 0, 4, 2))
    assert line.geometry.length == pytest.approx(3)


def knots() -> tuple[MultiPolygon, Polygon]:
    """Areas that overlap by a hair, and one whose rim crosses itself, as magnifying leaves them."""
    overlapping = MultiPolygon([box(0, 0, 2, 2), box(2 - 1e-9, 0, 4, 2)])
    hair = 1e-9
    rim = [(0, 0), (4, 0), (4, 2), (2, 2), (2 + hair, 2 + hair), (2 + 2 * hair, 2), (2 - hair, 2), (0, 2)]
    return overlapping, Polygon(rim)


def test_knots_of_rounding_are_no_obstacle() -> None:
    for knotted in knots():
        assert not knotted.is_valid
        (found,) = clipped([Shape(Ink.PANEL, knotted)], box(1, 1, 3, 9))
        assert found.geometry.is_valid
        assert found.geometry.area == pytest.approx(2, abs=1e-6)


def test_labels_are_asked_for_on_areas_without_knots() -> None:
    """What is seen of a flap may be knotted by rounding; labels in a glass are cut where it ends."""
    for knotted in knots():
        seen = SimpleNamespace(area=knotted, whole=knotted)
        flap = SimpleNamespace(joint=SimpleNamespace(id="j"), face=Face.PRINTED)
        things = [
            SimpleNamespace(kind=kind, name="P", flap=own) for kind, own in ((Kind.PART, None), (Kind.FLAP, flap))
        ]
        sights = tuple(SimpleNamespace(thing=thing, seen=seen) for thing in things)
        scenery = Scenery(sights, names={"P": "P"}, numbers={"j": 7})
        wishes = [*scenery.number_wishes(np.eye(3)), *scenery.name_wishes(np.eye(3))]
        assert [wish.text for wish in wishes] == ["7", "P"]
        assert all(wish.area.is_valid for wish in wishes)

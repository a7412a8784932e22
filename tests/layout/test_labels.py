"""Texts on pieces: legible, on their piece, off each other."""

import numpy as np
import pytest
import shapely
from shapely.geometry import Polygon, box

from popsim.geometry.flat import move_shape
from popsim.layout import Layout, draw_sheets, lay_out
from popsim.layout.fitted_text import LEGIBLE, RISE, Lettering
from popsim.layout.sheet import Text, text_width
from popsim.verification.random_designs import random_design

TINY = 60.0
"""mm^2; a piece below this has no room for its name beside its numbers."""


def letters(text: Text) -> Polygon:
    """What a centred text covers."""
    along = np.array([np.cos(text.angle), np.sin(text.angle)])
    half, up = along * text_width(text.text, text.size) / 2, np.array([-along[1], along[0]]) * RISE * text.size
    return Polygon([text.at - half, text.at + half, text.at + half + up, text.at - half + up])


@pytest.mark.parametrize("seed", range(3))
def test_labels_are_legible_and_do_not_collide(seed: int) -> None:
    layout: Layout = lay_out(random_design(seed, mechanisms=(2, 4)).design)
    for number, sheet in enumerate(draw_sheets(layout)):
        small = shapely.unary_union(
            [
                move_shape(placement.motion, placement.piece.outline)
                for placement in layout.placements
                if placement.sheet == number and placement.piece.outline.area < TINY
            ]
        )
        labels = [mark for mark in sheet.marks if isinstance(mark, Text) and mark.anchor == "middle"]
        assert all(label.size >= LEGIBLE for label in labels)
        boxes = [letters(label) for label in labels]
        clashes = [
            (labels[a].text, labels[b].text)
            for a, b in shapely.STRtree(boxes).query(boxes, predicate="intersects").T
            if a < b and not boxes[a].intersects(small)
        ]
        assert clashes == []


def test_a_label_goes_beside_a_place_that_is_too_small() -> None:
    lettering = Lettering(box(0, 0, 30, 30), Polygon())
    text = lettering.put("(12)", box(14, 14, 15, 15), 2.0)
    assert text.size == LEGIBLE
    assert letters(text).within(box(0, 0, 30, 30))
    assert letters(text).distance(box(14, 14, 15, 15)) < 3


def test_a_second_label_gives_way_to_the_first() -> None:
    lettering = Lettering(box(0, 0, 40, 10), Polygon())
    one, other = (lettering.put("7", box(0, 0, 40, 10), 3.0) for _ in range(2))
    assert letters(one).disjoint(letters(other))


def test_only_labels_on_pictures_have_a_rim() -> None:
    lettering = Lettering(box(0, 0, 40, 10), box(0, 0, 10, 10))
    assert lettering.put("1", box(0, 0, 10, 10), 3.0).halo
    assert not lettering.put("2", box(20, 0, 40, 10), 3.0).halo

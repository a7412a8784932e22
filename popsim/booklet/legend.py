"""Samples of what drawings are made of, each with its meaning."""

from collections.abc import Iterator

import numpy as np

from popsim import wording
from popsim.booklet.arrows import arrow
from popsim.booklet.depiction import PITCH, SLANT
from popsim.booklet.hatch import hatched
from popsim.booklet.inks import Ink
from popsim.booklet.labels import Labels, Wish
from popsim.booklet.shapes import Shape, drawn
from popsim.layout.sheet import Mark, Sheet

WIDTH, HEIGHT = 18.0, 7.5
"""mm; of a sample."""


def legend() -> tuple[tuple[Sheet, str], ...]:
    """Drawings with their meanings, in the order in which they are told."""
    samples = [
        (wording.NEW, _pair(Ink.NEW, Ink.NEW_REVERSE, Ink.NEW_EDGE)),
        (wording.OLD, _pair(Ink.PAPER, Ink.PAPER_REVERSE, Ink.EDGE)),
        (wording.CARD, _pair(Ink.PAGE, Ink.PAGE_REVERSE, Ink.EDGE)),
        (wording.GLUE, _hatched(Ink.HATCH, Ink.EDGE)),
        (wording.GLUE_BEHIND, _hatched(Ink.HATCH_BEHIND, Ink.RIM_BEHIND)),
        (wording.NUMBER, _number("7")),
        (wording.NUMBER_BEHIND, _number("(7)")),
        (wording.ARROW, _arrow()),
        (wording.GLASS, _glass()),
        (wording.MOUNTAIN, _line(Ink.MOUNTAIN)),
        (wording.VALLEY, _line(Ink.VALLEY)),
        (wording.HIDDEN, _line(Ink.HIDDEN)),
    ]
    return tuple((Sheet(text, WIDTH, HEIGHT, tuple(marks)), text) for text, marks in samples)


def _pair(front: Ink, back: Ink, edge: Ink) -> Iterator[Mark]:
    import shapely

    left, right = shapely.box(0.5, 0.7, 8.5, 6.8), shapely.box(9.5, 0.7, 17.5, 6.8)
    yield from drawn([Shape(front, left), Shape(back, right), Shape(edge, left.boundary.union(right.boundary))])


def _hatched(ink: Ink, rim: Ink) -> Iterator[Mark]:
    import shapely

    flap = shapely.Polygon([(1, 1.5), (17, 1.5), (14, 6), (4, 6)])
    yield from drawn([Shape(Ink.PAPER, flap), Shape(ink, hatched(flap, PITCH, SLANT)), Shape(rim, flap.boundary)])


def _number(text: str) -> Iterator[Mark]:
    import shapely

    frame = shapely.box(0, 0, WIDTH, HEIGHT)
    yield from Labels(frame, frame).place([Wish(text, frame, 3.0, badge=True)])


def _arrow() -> Iterator[Mark]:
    yield from drawn(arrow(np.array([[1.5, 2.0], [6.0, 4.6], [11.0, 5.2], [16.5, 3.6]])))


def _glass() -> Iterator[Mark]:
    import shapely

    small, large = shapely.Point(2.5, 3.7).buffer(1.2), shapely.Point(12.5, 3.7).buffer(3.5)
    line = shapely.LineString([(3.7, 3.7), (9.0, 3.7)])
    yield from drawn(
        [Shape(Ink.BUBBLE, large), Shape(Ink.GLASS, shapely.union_all([small.boundary, large.boundary, line]))]
    )


def _line(ink: Ink) -> Iterator[Mark]:
    import shapely

    yield from drawn([Shape(ink, shapely.LineString([(1, HEIGHT / 2), (WIDTH - 1, HEIGHT / 2)]))])

"""What is seen of a scene as inked shapes."""

from collections.abc import Iterable, Iterator

import numpy as np

from popsim.booklet.hatch import hatched
from popsim.booklet.inks import Ink
from popsim.booklet.shapes import Shape
from popsim.booklet.things import Kind, Sight

PITCH = 1.1
"""mm on the page between the lines of a hatching."""

SLANT = np.pi / 4
"""Angle of the hatching."""

FILLS = {
    (False, True): Ink.PAPER,
    (False, False): Ink.PAPER_REVERSE,
    (True, True): Ink.NEW,
    (True, False): Ink.NEW_REVERSE,
}
"""By whether a thing is new, and whether its printed side is seen."""


def depict(sights: Iterable[Sight], scale: float) -> tuple[Shape, ...]:
    """Shapes of all things, in mm of the picture, to be printed at `scale`; none of them is empty."""
    shapes = (shape for sight in sights for shape in _shapes(sight, PITCH / scale))
    return tuple(shape for shape in shapes if not shape.geometry.is_empty)


def _shapes(sight: Sight, pitch: float) -> Iterator[Shape]:
    thing, seen = sight.thing, sight.seen
    yield Shape(_fill(sight), seen.area)
    if thing.flap is not None:
        if thing.glue_side(seen.printed):
            yield Shape(Ink.HATCH, hatched(seen.area, pitch, SLANT))
        else:
            yield Shape(Ink.HATCH_BEHIND, hatched(seen.whole, pitch, SLANT))
            yield Shape(Ink.RIM_BEHIND, seen.whole.boundary)
    if thing.kind is Kind.PLACE:
        yield Shape(Ink.HATCH, seen.edges)
        return
    if thing.new or thing.flap is not None:
        yield Shape(Ink.HIDDEN, seen.hidden)
    yield Shape(Ink.CREASE, seen.creases)
    yield Shape(Ink.NEW_EDGE if thing.new else Ink.EDGE, seen.edges)


def _fill(sight: Sight) -> Ink:
    if sight.thing.kind is Kind.PAGE and not sight.thing.new:
        return Ink.PAGE if sight.seen.printed else Ink.PAGE_REVERSE
    return FILLS[sight.thing.new, sight.seen.printed]

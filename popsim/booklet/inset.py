"""A magnifying glass for flaps that are too small to be made out."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.depiction import depict
from popsim.booklet.inks import Ink
from popsim.booklet.labels import Labels
from popsim.booklet.scenery import Scenery
from popsim.booklet.shapes import clipped, drawn, moved
from popsim.booklet.things import Sight
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape
from popsim.layout.sheet import Area, Line, Mark

if TYPE_CHECKING:
    from shapely.geometry import Polygon

LEGIBLE = 3.2
"""mm on the page; flaps that look narrower get an inset."""

RADIUS = 12.5
"""mm; of the glass."""

LEAST, MOST = 1.8, 5.0
"""How much it magnifies."""


@dataclass(frozen=True, eq=False)
class Inset:
    """A round window.

    Attributes
    ----------
    centre, source:
        Its middle on the page, and the spot that it shows, shapes (2,), mm.
    power:
        How many times larger it shows it.
    """

    centre: FloatArray
    source: FloatArray
    power: float

    @property
    def window(self) -> "Polygon":
        """The glass."""
        return _disc(self.centre, RADIUS)

    @property
    def spot(self) -> "Polygon":
        """What is seen through it."""
        return _disc(self.source, RADIUS / self.power)

    def motion(self, motion: FloatArray) -> FloatArray:
        """Motion (3, 3) into the glass of what `motion` brings onto the page."""
        grow = np.diag([self.power, self.power, 1.0])
        grow[:2, 2] = self.centre - self.power * self.source
        return grow @ motion

    def marks(self, scenery: Scenery, motion: FloatArray, scale: float) -> Iterator[Mark]:
        """The glass, what is seen in it, and the ring round the spot that it shows."""
        rim = np.array(self.window.exterior.coords)[:-1]
        ring = np.array(self.spot.exterior.coords)[:-1]
        along = (self.centre - self.source) / np.linalg.norm(self.centre - self.source)
        yield Line(Ink.GLASS, ring, closed=True)
        yield Line(Ink.GLASS, np.array([self.source + RADIUS / self.power * along, self.centre - RADIUS * along]))
        yield Area(Ink.BUBBLE, (rim,))
        shapes = moved(depict(scenery.sights, scale * self.power), self.motion(motion))
        yield from drawn(clipped(shapes, self.window))
        yield Line(Ink.GLASS, rim, closed=True)
        labels = Labels(self.window.buffer(-0.3), self.window)
        wishes = scenery.number_wishes(self.motion(motion))
        inside = [replace(wish, area=wish.area.intersection(self.window)) for wish in wishes]
        yield from labels.place(wish for wish in inside if not wish.area.is_empty)


def choose_inset(scenery: Scenery, motion: FloatArray, scale: float, panel: "Polygon") -> Inset | None:
    """An inset over the flap that is seen best, in the emptiest corner; None where flaps are large."""
    import shapely

    glued = [sight for sight in scenery.glued if not sight.seen.whole.is_empty]
    if not glued:
        return None
    sight = max(glued, key=_clarity)
    width = scale * _width(sight.seen.whole)
    if width >= LEGIBLE:
        return None
    power = float(np.clip(1.5 * LEGIBLE / max(width, 1e-6), LEAST, MOST))
    source = move(motion, np.array(sight.seen.whole.representative_point().coords[0]))
    low, high = np.array(panel.bounds[:2]) + RADIUS + 1, np.array(panel.bounds[2:]) - RADIUS - 1
    corners = [np.array([x, y]) for y in (low[1], high[1]) for x in (high[0], low[0])]
    silhouette = move_shape(motion, scenery.silhouette)

    def cost(corner: FloatArray) -> float:
        glass = _disc(corner, RADIUS)
        near = RADIUS * (1 + 1 / power) + 2 > float(np.linalg.norm(corner - source))
        return float(shapely.area(glass.intersection(silhouette))) + 1000 * near

    return Inset(min(corners, key=cost), source, power)


def _clarity(sight: Sight) -> tuple[bool, float]:
    """More is seen better: glue towards the eye first, then what is seen of it."""
    return sight.thing.glue_side(sight.seen.printed), round(sight.seen.area.area, 3)


def _width(shape: "Polygon") -> float:
    """The shorter side of the smallest rectangle round a shape, mm."""
    corners = np.array(shape.minimum_rotated_rectangle.exterior.coords)[:3]
    return float(np.linalg.norm(np.diff(corners, axis=0), axis=1).min())


def _disc(centre: FloatArray, radius: float) -> "Polygon":
    import shapely

    return shapely.Point(centre).buffer(radius, quad_segs=16)

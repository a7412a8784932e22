"""Labels that do not collide: inside what they name where there is room, else beside it with a line to it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.inks import Ink
from popsim.geometry.arrays import FloatArray
from popsim.layout.fitted_text import RISE
from popsim.layout.sheet import Area, Line, Mark, Text, text_width

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

PAD = 0.5
"""mm round the text of a label."""

DISTANCES = (4.0, 6.5, 9.0, 12.0, 16.0, 21.0, 27.0, 35.0)
"""mm from what a label names to its middle."""

DIRECTIONS = 16
"""Directions tried at each distance."""

OFFSETS = np.array(
    [
        [distance * np.cos(angle), distance * np.sin(angle)]
        for distance in DISTANCES
        for angle in 0.2 + np.arange(DIRECTIONS) * 2 * np.pi / DIRECTIONS
    ]
)
"""All places that are tried, from what is named, mm, shape (n, 2)."""

SURER = 1e-6
"""By how much a place farther away must be better to be taken."""

COVERED, CROSSED, AWAY = 6.0, 8.0, 0.25
"""What a label costs that lies on the drawing altogether, whose line crosses others, and per mm of distance."""


@dataclass(frozen=True, eq=False)
class Wish:
    """A label that is wanted.

    Attributes
    ----------
    text:
        What it says.
    area:
        What it names, as far as that is seen, on the page, mm.
    size:
        mm; of the font.
    badge:
        A number in a ring; else plain words.
    inside:
        Whether it may stand within the area.
    """

    text: str
    area: "BaseGeometry"
    size: float
    badge: bool = False
    inside: bool = True


@dataclass
class Labels:
    """Places labels one after the other.

    Attributes
    ----------
    window:
        Where labels may be.
    drawing:
        What is better not covered.
    taken:
        Boxes and lines of the labels placed so far, and whatever else must stay free.
    """

    window: "Polygon"
    drawing: "BaseGeometry"
    taken: list["BaseGeometry"] = field(default_factory=list)

    def place(self, wishes: Iterable[Wish]) -> Iterator[Mark]:
        """Marks of all labels; one for which there is no place at all is left out."""
        for wish in wishes:
            found = self._inside(wish) or self._beside(wish)
            if found is not None:
                middle, leader = found
                self.taken.append(_box(wish, middle))
                if leader is not None:
                    self.taken.append(_line(leader))
                    yield Line(Ink.LEADER, leader)
                yield from _label(wish, middle)

    def _free(self, shape: "BaseGeometry") -> bool:
        return bool(self.window.contains(shape)) and not any(shape.intersects(other) for other in self.taken)

    def _inside(self, wish: Wish) -> tuple[FloatArray, None] | None:
        import shapely

        parts = [part for part in shapely.get_parts(wish.area) if part.geom_type == "Polygon" and part.area > 0]
        if not wish.inside or not parts:
            return None
        part = max(parts, key=lambda part: float(part.area))
        widest = shapely.maximum_inscribed_circle(part, tolerance=0.2)
        for spot in (part.centroid, widest):
            middle = np.array(spot.coords[0])
            box = _box(wish, middle)
            if part.contains(box) and self._free(box):
                return middle, None
        return None

    def _beside(self, wish: Wish) -> tuple[FloatArray, FloatArray] | None:
        """Middle and leader of the best free place near what is named."""
        import shapely

        if wish.area.is_empty:
            return None
        anchor = np.array(wish.area.representative_point().coords[0])
        middles, half = anchor + OFFSETS, _half(wish)
        boxes = shapely.box(*(middles - half).T, *(middles + half).T)
        leaders = shapely.linestrings(np.stack([np.broadcast_to(anchor, middles.shape), middles], axis=1))
        taken = shapely.union_all(self.taken)
        shapely.prepare([self.window, taken])
        free = shapely.contains(self.window, boxes) & ~shapely.contains(boxes, shapely.Point(anchor))
        free[free] = ~shapely.intersects(taken, boxes[free])
        places = np.flatnonzero(free)
        leaders[places] = shapely.difference(leaders[places], boxes[places])
        cost = AWAY * np.linalg.norm(OFFSETS[places], axis=1) + CROSSED * shapely.intersects(
            taken, leaders[places]
        )
        best, least = None, np.inf
        for k in np.argsort(cost.round(6), kind="stable"):
            if cost[k] >= least:
                break
            box = boxes[places[k]]
            full = cost[k] + COVERED * float(self.drawing.intersection(box).area / box.area)
            if full < least - SURER:
                best, least = places[k], full
        return None if best is None else (middles[best], shapely.get_coordinates(leaders[best]))


def _label(wish: Wish, middle: FloatArray) -> Iterator[Mark]:
    box = np.array(_box(wish, middle).exterior.coords)[:-1]
    if wish.badge:
        yield Area(Ink.BUBBLE, (box,))
        yield Line(Ink.BADGE, box, closed=True)
    base = middle - np.array([0.0, RISE / 2 * wish.size])
    yield Text(Ink.BADGE if wish.badge else Ink.TEXT, wish.text, base, wish.size, anchor="middle", bold=wish.badge)


def _half(wish: Wish) -> FloatArray:
    """Half the width and height of a label, shape (2,)."""
    return np.array([text_width(wish.text, wish.size), RISE * wish.size]) / 2 + PAD


def _box(wish: Wish, middle: FloatArray) -> "Polygon":
    import shapely

    half = _half(wish)
    if wish.badge:
        reach = np.array([half[0] - half[1], 0.0])
        return shapely.LineString([middle - reach, middle + reach]).buffer(half[1])
    return shapely.box(*(middle - half), *(middle + half))


def _line(ends: FloatArray) -> "BaseGeometry":
    import shapely

    return shapely.LineString(ends)

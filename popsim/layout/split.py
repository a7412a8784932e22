"""Dividing flat shapes that exceed the sheet, along straight lines."""

from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.design.rules import TOUCHING
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common
from popsim.layout.too_large import Room, fits, sides_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon

CANDIDATES = 25
"""Places tried for each seam."""

ALIGNED = 500.0
"""mm of seam that it is worth to divide a patch where its neighbour is divided: flaps between them stay whole."""

CROSSING = 20.0
"""mm of seam that crossing one hinge is worth."""

UNEVEN = 0.2
"""mm of seam that it is worth to come nearer to where a seam should be by 1 mm."""

NO_STRIP = 30.0
"""mm; what is left beside a large part is no narrower."""

SLACK = 0.01
"""mm that parts are smaller than the sheet: far above rounding, far below paper."""

WINDOW = 0.125
"""How far from where it should be a seam may be, of the range of its places, where it is told where to be."""


class Hints(NamedTuple):
    """What seams heed, flat: hinge lines (2, 2) that they avoid, points (2,) where neighbours are divided."""

    lines: list[FloatArray]
    wished: list[FloatArray]


class Range(NamedTuple):
    """Where a seam can be: the axis across it (0 or 1), its least and its greatest place on that, mm."""

    axis: int
    least: float
    most: float


class Flaps(NamedTuple):
    """What flaps may add to a part, mm: along each axis that is not divided, (2,), and along one that is."""

    whole: FloatArray
    seams: float


def cut(
    polygon: "Polygon",
    room: Room,
    flaps: Flaps,
    hints: Hints,
    *,
    leaning: float | None = None,
    more: int = 0,
    grain: bool = False,
) -> list["Polygon"]:
    """Divide until every part fits; seams run along the flat axes.

    Parameters
    ----------
    room:
        Width and height of the sheet, mm.
    leaning:
        Where seams are in their range, 0 to 1, as nearly as may be; None for wherever they are short and cross no
        hinge, the first part rather large than not.
    more:
        How many parts more are made than must be.
    grain:
        Whether parts go onto the sheet upright only.
    """
    if fits(polygon, room, flaps.whole, grain=grain):
        return [polygon]
    span = _range(polygon, room, flaps, more, grain)
    halves = _halves(polygon, span.axis, _place(polygon, span, hints, leaning))
    within = Flaps(np.where(np.arange(2) == span.axis, flaps.seams, flaps.whole), flaps.seams)
    return [part for half in halves for part in cut(half, room, within, hints, leaning=leaning, grain=grain)]


def halved(polygon: "Polygon", axis: int, hints: Hints, leaning: float) -> list["Polygon"]:
    """Divide once, across a flat axis, what need not be divided; nothing where it is too short to.

    `leaning` as for :func:`cut`, of all places that leave no strip.
    """
    low, high = polygon.bounds[axis] + NO_STRIP, polygon.bounds[2 + axis] - NO_STRIP
    return _halves(polygon, axis, _place(polygon, Range(axis, low, high), hints, leaning)) if low < high else []


def _place(polygon: "Polygon", span: Range, hints: Hints, leaning: float | None) -> float:
    """Where in its range the seam is best."""
    ideal = span.least + (1.0 if leaning is None else leaning) * (span.most - span.least)
    reach = inf if leaning is None else WINDOW * (span.most - span.least)
    wished = [float(spot[span.axis]) for spot in hints.wished if span.least < spot[span.axis] < span.most]
    places = [*np.linspace(span.least, span.most, CANDIDATES), *wished]

    def cost(place: float) -> tuple[float, float]:
        bonus = ALIGNED if min((abs(place - spot) for spot in wished), default=1.0) < TOUCHING else 0.0
        return _cost(polygon, span.axis, place, hints.lines) + UNEVEN * abs(place - ideal) - bonus, place

    return min((float(place) for place in places if abs(place - ideal) <= reach + TOUCHING), key=cost)


def _range(polygon: "Polygon", room: Room, flaps: Flaps, more: int, grain: bool) -> Range:
    """Where the first seam can be so that few parts are made, and the first of them can be largest."""
    low = np.array(polygon.bounds[:2])
    size = np.array(polygon.bounds[2:]) - low
    found = []
    for sides in sides_of(room, grain):
        limits = sides - flaps.seams - SLACK
        counts = np.where(size + flaps.whole <= sides, 1, np.maximum(np.ceil(size / limits), 2))
        axis = int(counts[1] > counts[0])
        found.append(
            (int(counts.prod()), -float(limits[axis]), float((counts[axis] - 1 + more) * limits[axis]), axis)
        )
    _, limit, rest, axis = min(found)
    strip = min(NO_STRIP, size[axis] / 2)
    least = max(size[axis] - rest, strip)
    most = max(least, min(-limit, size[axis] - strip))
    return Range(axis, float(low[axis] + least), float(low[axis] + most))


def _cost(polygon: "Polygon", axis: int, place: float, lines: list[FloatArray]) -> float:
    """Length of the seam at `place`, and more for each hinge that it crosses."""
    from shapely.geometry import LineString

    ends = np.full((2, 2), place)
    ends[:, 1 - axis] = polygon.bounds[1 - axis], polygon.bounds[3 - axis]
    crossed = sum((line[0, axis] - place) * (line[1, axis] - place) < 0 for line in lines)
    return float(polygon.intersection(LineString(ends)).length + CROSSING * crossed)


def _halves(polygon: "Polygon", axis: int, place: float) -> list["Polygon"]:
    import shapely
    from shapely.geometry import Polygon, box

    bounds = list(polygon.bounds)
    pieces = []
    for end in (axis, 2 + axis):
        window = [bounds[0] - 1, bounds[1] - 1, bounds[2] + 1, bounds[3] + 1]
        window[2 + axis if end == axis else axis] = place
        found = shapely.get_parts(common(polygon, box(*window)))
        pieces += [piece for piece in found if isinstance(piece, Polygon) and piece.area > 0]
    if len(pieces) < 2:  # a place at the rim cuts nothing off: halve instead of going on for ever
        return _halves(polygon, axis, (bounds[axis] + bounds[2 + axis]) / 2) if -inf < place < inf else pieces
    return [shapely.orient_polygons(piece) for piece in pieces]

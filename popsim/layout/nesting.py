"""Nesting pieces on sheets: first fit on rasters, in many orders.

Pieces go largest first, by several measures and with their sizes taken at random within limits. For each piece the
sheets are searched in order, and on a sheet the lowest, then leftmost place of all its turns. The best result is
kept: fewest sheets, then all but the last well filled, then least on the last. Coarse rasters show quickly which
orders are worth a fine one; shapely has the last word.
"""

from collections.abc import Callable, Iterator
from functools import cache
from itertools import islice
from math import ceil
from random import Random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import flat_motion, move_shape
from popsim.layout.errors import LayoutError
from popsim.layout.sheet_raster import Grid, SheetRaster, Turns

if TYPE_CHECKING:
    from shapely.geometry import Polygon

FINE, COARSE = 1.0, 2.0
"""mm; sides of raster cells."""

SQUARE = 1e-3
"""Radians; a smallest rectangle that is turned by less is upright."""

MEASURES: tuple[Callable[["Polygon"], float], ...] = (
    lambda shape: float(shape.area),
    lambda shape: float(shape.envelope.area),
    lambda shape: float(shape.convex_hull.area),
)
"""Orders that are tried: largest first, by these."""

FIRST, TRIES, BEST = 6, 60, 4
"""Orders tried with fine cells, then with coarse ones if sheets are still to be saved or filled; how many of those
are tried with fine cells too."""

WELL_FILLED = 0.55
"""Share of the area that pieces should take on every sheet but the last."""

DENSE = 0.85
"""Share of the area that irregular pieces hardly exceed: no order saves a sheet beyond."""

SMALLEST_SHARE = 0.4
"""In a random order a piece counts as this share of its size at least: large ones still go early."""


class Waste(NamedTuple):
    """What a nesting wastes; less is better.

    Attributes
    ----------
    sheets:
        Their number.
    lacking:
        What all but the last lack to be well filled, in sheets.
    last:
        How full the emptiest is, 0..1.
    even:
        How evenly the others are filled, negative.
    emptiest:
        Indices of the last sheet and of those that are not well filled.
    """

    sheets: int
    lacking: float
    last: float
    even: float
    emptiest: tuple[int, ...]


class Place(NamedTuple):
    """Where a shape goes: index of the sheet, flat motion (3, 3) into the area's coordinates."""

    sheet: int
    motion: FloatArray


def nest(
    shapes: list["Polygon"], names: list[str], room: tuple[float, float], gap: float, grain: bool
) -> list[Place]:
    """Place all shapes without overlap on as few sheets as first fit finds.

    Parameters
    ----------
    names:
        What errors call the shapes.
    room:
        Width and height of the usable area of a sheet, mm.
    gap:
        Least distance between two shapes, mm.
    grain:
        Turn by half turns only.

    Raises
    ------
    LayoutError
        A shape exceeds the area at every angle.
    """
    angles = [_angles(shape, room, grain) for shape in shapes]
    for index, own in enumerate(angles):
        if not own:
            raise _too_large(shapes[index], names[index], room)
    bench = _Bench(shapes, angles, room, gap)
    orders = _orders(shapes)
    best = min((bench.filling(FINE, order) for order in islice(orders, FIRST)), key=bench.waste)
    if not bench.suffices(best):
        more = sorted(orders, key=lambda order: (bench.waste(bench.filling(COARSE, order)), order))
        coarse = [bench.filling(COARSE, order) for order in more[:1]]
        best = min([best, *(bench.filling(FINE, order) for order in more[:BEST]), *coarse], key=bench.waste)
    _judge(shapes, names, best, room, gap)
    return _emptiest_last(best, shapes)


def estimate(shapes: list["Polygon"], room: tuple[float, float], gap: float, grain: bool) -> Waste | None:
    """What these shapes would about waste, by a few orders on coarse rasters; None where one does not fit."""
    angles = [_angles(shape, room, grain) for shape in shapes]
    if not all(angles):
        return None
    bench = _Bench(shapes, angles, room, gap)
    return min(bench.waste(bench.filling(COARSE, order)) for order in islice(_orders(shapes), FIRST))


def waste_of(shapes: list["Polygon"], places: list[Place], room: tuple[float, float]) -> Waste:
    """What a nesting wastes of an area of this width and height, mm."""
    filled = _filled(places, shapes) / (room[0] * room[1])
    rank = np.argsort(filled, kind="stable")
    lacking = np.maximum(WELL_FILLED - filled[rank[1:]], 0.0)
    emptiest = tuple(int(k) for k in (*rank[:1], *rank[1:][lacking > 0]))
    return Waste(
        len(filled), float(lacking.sum()), float(filled.min(initial=1.0)), -float((filled**2).sum()), emptiest
    )


def _orders(shapes: list["Polygon"]) -> Iterator[tuple[int, ...]]:
    """Orders in which the shapes are placed, each once: by each measure, then by sizes varied at random."""
    random, seen = Random(0), set()
    for turn in range(TRIES):
        sizes = [MEASURES[turn % len(MEASURES)](shape) for shape in shapes]
        if turn >= len(MEASURES):
            sizes = [size * random.uniform(SMALLEST_SHARE, 1.0) for size in sizes]
        order = tuple(int(k) for k in np.argsort(-np.array(sizes), kind="stable"))
        if order not in seen:
            seen.add(order)
            yield order


class _Bench:
    """Shapes that are tried in many orders on rasters of several cells."""

    def __init__(
        self, shapes: list["Polygon"], angles: list[list[float]], room: tuple[float, float], gap: float
    ) -> None:
        self.shapes, self.angles, self.room, self.gap = shapes, angles, room, gap
        self.turns = cache(self._turns)
        self.filling = cache(self._filling)

    def waste(self, places: list[Place]) -> Waste:
        """What a filling wastes."""
        return waste_of(self.shapes, places, self.room)

    def suffices(self, places: list[Place]) -> bool:
        """Whether other orders could neither save a sheet nor fill one that is not well filled."""
        waste = self.waste(places)
        area = sum(shape.area for shape in self.shapes)
        return not waste.lacking and waste.sheets <= ceil(area / (DENSE * self.room[0] * self.room[1]))

    def _turns(self, cell: float) -> list[Turns]:
        grid = Grid.over(self.room, self.gap, cell)
        return [Turns.of(shape, own, self.gap, grid) for shape, own in zip(self.shapes, self.angles, strict=True)]

    def _filling(self, cell: float, order: tuple[int, ...]) -> list[Place]:
        """First fit of all shapes in the given order."""
        sheets: list[SheetRaster] = []
        turns = self.turns(cell)
        places = {index: _put(turns[index], sheets) for index in order}
        return [places[index] for index in range(len(self.shapes))]


def _filled(places: list[Place], shapes: list["Polygon"]) -> FloatArray:
    """Area that is taken on each sheet, mm^2, shape (n,)."""
    filled = np.zeros(max((place.sheet for place in places), default=-1) + 1)
    for place, shape in zip(places, shapes, strict=True):
        filled[place.sheet] += shape.area
    return filled


def _emptiest_last(places: list[Place], shapes: list["Polygon"]) -> list[Place]:
    """The same places on sheets in order of how full they are."""
    filled = _filled(places, shapes)
    rank = {sheet: k for k, sheet in enumerate(sorted(range(len(filled)), key=lambda k: (-filled[k], k)))}
    return [Place(rank[place.sheet], place.motion) for place in places]


def _put(turns: Turns, sheets: list[SheetRaster]) -> Place:
    for number in range(len(sheets) + 1):
        if number == len(sheets):
            sheets.append(SheetRaster(turns.grid))
        spot = sheets[number].lowest(turns)
        if spot is not None:
            sheets[number].take(spot, turns)
            return Place(number, turns.motion(spot))
    raise AssertionError("a shape that goes on an empty sheet was not placed on one")


def _angles(shape: "Polygon", room: tuple[float, float], grain: bool) -> list[float]:
    """Angles at which the shape goes into the area: its own and along its smallest rectangle, by quarter turns."""
    corners = np.array(shape.minimum_rotated_rectangle.exterior.coords)
    longest = max(np.diff(corners[:3], axis=0), key=lambda side: (round(float(np.linalg.norm(side)), 6), side[0]))
    aslant = float(np.arctan2(longest[1], longest[0])) % (np.pi / 2)
    starts = [0.0] if grain or min(aslant, np.pi / 2 - aslant) < SQUARE else [0.0, -aslant]
    found = []
    for angle in (start + quarter * np.pi / 2 for start in starts for quarter in ((0, 2) if grain else range(4))):
        low_x, low_y, high_x, high_y = move_shape(flat_motion(angle), shape).bounds
        if high_x - low_x <= room[0] + 1e-9 and high_y - low_y <= room[1] + 1e-9:
            found.append(angle)
    return found


def _too_large(shape: "Polygon", name: str, room: tuple[float, float]) -> LayoutError:
    low_x, low_y, high_x, high_y = shape.bounds
    size = sorted((high_x - low_x, high_y - low_y))
    scale = np.floor(1000 * min(have / want for have, want in zip(sorted(room), size, strict=True))) / 1000
    return LayoutError(
        f"piece {name} measures {size[0]:.1f} x {size[1]:.1f} mm with its flaps, more than the {room[0]:.0f} x "
        f"{room[1]:.0f} mm within the margins; scale the design by {scale:.3f} or less, or use larger paper"
    )


def _judge(
    shapes: list["Polygon"], names: list[str], places: list[Place], room: tuple[float, float], gap: float
) -> None:
    """Raise LayoutError if shapes come closer than `gap` or leave the area: the raster would be at fault."""
    import shapely

    area = shapely.box(0, 0, *room).buffer(1e-6)
    for sheet in range(max((place.sheet for place in places), default=-1) + 1):
        own = [k for k, place in enumerate(places) if place.sheet == sheet]
        moved = [move_shape(places[k].motion, shapes[k]) for k in own]
        tree = shapely.STRtree(moved)
        near = tree.query(moved, predicate="dwithin", distance=gap - 1e-6)
        clash = [(own[a], own[b]) for a, b in near.T if a < b]
        outside = [own[k] for k, shape in enumerate(moved) if not area.contains(shape)]
        if clash or outside:
            pair = clash[0] if clash else (outside[0], outside[0])
            raise LayoutError(
                f"pieces {names[pair[0]]} and {names[pair[1]]} were nested wrongly; report this design"
            )

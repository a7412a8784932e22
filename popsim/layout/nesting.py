"""Nesting pieces on sheets: snug fit on rasters, in many orders.

Pieces are placed one after another, each on the first sheet with room for it, at its snuggest place there. From
orders that put large ones first small changes lead to better ones: fewest sheets, then all but the last well
filled, then least on the last. Coarse rasters show quickly which orders are worth a fine one; shapely has the last
word.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from math import ceil
from random import Random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.flat import flat_motion, move_shape
from popsim.layout.errors import LayoutError
from popsim.layout.filling import Filler, Filling, Place
from popsim.layout.orders import Order, first_orders
from popsim.layout.waste import Waste, taken_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon


class Pass(NamedTuple):
    """How long orders are changed on one raster while sheets are still to be saved or filled.

    Attributes
    ----------
    cell:
        Side of the raster's cells, mm.
    changes:
        Orders tried.
    effort:
        Cells looked at after which no more are tried.
    """

    cell: float
    changes: int
    effort: int

    def longer(self, times: int) -> "Pass":
        """The same with this many times as many orders, as far as `MORE` times the effort goes."""
        return Pass(self.cell, times * self.changes, min(times, MORE) * self.effort)


COARSE, FINE = Pass(2.0, 60, 100_000_000), Pass(1.0, 20, 100_000_000)

MORE = 3
"""Times as much effort who is patient makes at most."""

SQUARE = 1e-3
"""Radians; a smallest rectangle that is turned by less is upright."""

BEST = 4
"""Orders of the coarse cells that are tried with fine ones."""

DENSE = 0.85
"""Share of the area that irregular pieces hardly exceed: no order saves a sheet beyond."""


def nest(
    shapes: list["Polygon"],
    names: list[str],
    room: tuple[float, float],
    gap: float,
    grain: bool,
    *,
    patience: int = 1,
) -> list[Place]:
    """Place all shapes without overlap on as few sheets as the orders tried need.

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
    patience:
        How many times as many orders are tried as usual.

    Raises
    ------
    LayoutError
        A shape exceeds the area at every angle.
    """
    angles = [_angles(shape, room, grain) for shape in shapes]
    for index, own in enumerate(angles):
        if not own:
            raise LayoutError(f"piece {names[index]} does not go onto the sheet at any angle")
    random = Random(0)
    limits = [each.longer(patience) for each in (COARSE, FINE)]
    coarse, fine = (_filler(shapes, angles, room, gap, each.cell) for each in limits)
    tried = _climbed(coarse, first_orders(dict(enumerate(shapes)), random), limits[0], random)
    kept = sorted(tried, key=lambda order: (tried[order].waste, order))[:BEST]
    again = _climbed(fine, kept, limits[1], random)
    best = min((tried[kept[0]], *again.values()), key=lambda filling: filling.waste)
    places = _emptiest_last(best.places, fine.shares)
    last = [k for k, place in enumerate(places) if place.sheet == best.waste.sheets - 1]
    for k, place in _gathered([shapes[k] for k in last], [angles[k] for k in last], room, gap):
        places[last[k]] = Place(best.waste.sheets - 1, place.motion)
    _judge(shapes, names, places, room, gap)
    return places


def suffices(waste: Waste, shares: Sequence[float]) -> bool:
    """Whether nothing could save a sheet, or fill one that is not well filled."""
    return not waste.lacking and waste.sheets <= ceil(sum(shares) / DENSE)


class Estimator:
    """What shapes would about waste, by a few orders on coarse rasters.

    Most of them are asked about again and again, with others: what is known of them is kept.
    """

    def __init__(self, room: tuple[float, float], gap: float, grain: bool) -> None:
        self._room, self._grain = room, grain
        self._filler = Filler(room, gap, COARSE.cell)
        self._known: dict[tuple[bytes, int], int | None] = {}

    @property
    def effort(self) -> int:
        """Cells looked at so far."""
        return self._filler.effort

    def waste(self, shapes: Sequence["Polygon"]) -> Waste | None:
        """What these would waste; None where one of them does not go onto a sheet."""
        known: dict[int, Polygon] = {}
        seen: Counter[bytes] = Counter()
        for shape in shapes:
            index = self._index(shape, seen)
            if index is None:
                return None
            known[index] = shape
        return min(self._filler.filling(order).waste for order in first_orders(known, Random(0), varied=0))

    def _index(self, shape: "Polygon", seen: Counter[bytes]) -> int | None:
        """What the filler calls a shape; twins differ by how many were `seen` before."""
        content = shape.wkb
        seen[content] += 1
        key = content, seen[content]
        if key not in self._known:
            angles = _angles(shape, self._room, self._grain)
            self._known[key] = self._filler.add(shape, angles) if angles else None
        return self._known[key]


def _filler(
    shapes: Sequence["Polygon"],
    angles: Sequence[Sequence[float]],
    room: tuple[float, float],
    gap: float,
    cell: float,
    *,
    low: bool = False,
) -> Filler:
    """A filler that has all these shapes, in their order."""
    filler = Filler(room, gap, cell, low=low)
    for shape, own in zip(shapes, angles, strict=True):
        filler.add(shape, own)
    return filler


def _climbed(filler: Filler, orders: Iterable[Order], limits: Pass, random: Random) -> dict[Order, Filling]:
    """All orders tried until one suffices, with what they give: those given, then small changes to the best."""
    tried: dict[Order, Filling] = {}
    for order in orders:
        tried[order] = filler.filling(order)
        if suffices(tried[order].waste, filler.shares):
            break
    best = min(tried, key=lambda order: (tried[order].waste, order))
    for _ in range(limits.changes):
        if filler.effort > limits.effort or suffices(tried[best].waste, filler.shares):
            break
        order = best.changed(random)
        tried[order] = filler.filling(order)
        if tried[order].waste <= tried[best].waste:
            best = order
    return tried


def _gathered(
    shapes: list["Polygon"], angles: list[list[float]], room: tuple[float, float], gap: float
) -> Iterable[tuple[int, Place]]:
    """Places of all shapes of one sheet low on it, so that notes find room above; none where they do not fit."""
    lowest = _filler(shapes, angles, room, gap, FINE.cell, low=True)
    for order in first_orders(dict(enumerate(shapes)), Random(0)):
        filling = lowest.filling(order)
        if filling.waste.sheets == 1:
            return enumerate(filling.places)
    return ()


def _emptiest_last(places: Sequence[Place], shares: Sequence[float]) -> list[Place]:
    """The same places on sheets in order of how full they are."""
    taken = taken_of(shares, [place.sheet for place in places])
    rank = {sheet: k for k, sheet in enumerate(sorted(range(len(taken)), key=lambda k: (-taken[k], k)))}
    return [Place(rank[place.sheet], place.motion) for place in places]


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


def _judge(
    shapes: list["Polygon"], names: list[str], places: Sequence[Place], room: tuple[float, float], gap: float
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

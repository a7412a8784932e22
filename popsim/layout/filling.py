"""Filling sheets with pieces in a given order, on rasters of one cell; what was tried once is remembered."""

from collections.abc import Sequence
from functools import lru_cache
from math import prod
from typing import TYPE_CHECKING, NamedTuple

from popsim.geometry.arrays import FloatArray
from popsim.layout.orders import First, Order
from popsim.layout.sheet_raster import Fit, Grid, SheetRaster, Spot, Turns
from popsim.layout.too_large import Room
from popsim.layout.waste import WELL_FILLED, Waste, waste_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon

KEPT = 128
"""Sheets whose spectra are kept: those of the orders tried last."""

Contents = frozenset[tuple[int, Spot]]
"""What lies on a sheet: indices of pieces, and where."""


class Place(NamedTuple):
    """Where a shape goes: index of the sheet, flat motion (3, 3) into the area's coordinates."""

    sheet: int
    motion: FloatArray


class Filling(NamedTuple):
    """What the shapes of an order waste, and their places in the order in which they were added."""

    waste: Waste
    places: tuple[Place, ...]


class Filler:
    """Fills sheets with shapes in one order after another.

    Parameters
    ----------
    room, gap:
        Width and height of the usable area and the least distance between two shapes, mm.
    cell:
        Side of the raster's cells, mm.
    low:
        Put each shape as low as it goes instead of where it fits most snugly: what stays free is in one piece.

    Attributes
    ----------
    shares:
        Of a sheet that each shape takes, in the order in which they were added.
    effort:
        Cells looked at so far.
    """

    def __init__(self, room: Room, gap: float, cell: float, *, low: bool = False) -> None:
        self.effort = 0
        self.shares: list[float] = []
        self._room, self._gap, self._low = room, gap, low
        self._grid = Grid.over(room, gap, cell)
        self._turns: list[Turns] = []
        self._sheets: dict[Contents, SheetRaster] = {frozenset(): SheetRaster.empty(self._grid)}
        self._spectrum = lru_cache(KEPT)(lambda contents: self._sheets[contents].spectrum())
        self._before: dict[Contents, Contents] = {}
        self._fits: dict[tuple[Contents, int], Fit] = {}
        self._fillings: dict[Order, Filling] = {}

    def add(self, shape: "Polygon", angles: Sequence[float]) -> int:
        """Take a shape that goes onto a sheet at `angles`, rad; return the index by which orders call it."""
        self.shares.append(shape.area / (self._room[0] * self._room[1]))
        self._turns.append(Turns.of(shape, angles, self._gap, self._grid))
        return len(self._turns) - 1

    def filling(self, order: Order) -> Filling:
        """The shapes of an order on sheets, one after another."""
        if order not in self._fillings:
            places = self._placed(order)
            taken = sorted(places)
            waste = waste_of([self.shares[k] for k in taken], [places[k].sheet for k in taken])
            self._fillings[order] = Filling(waste, tuple(places[k] for k in taken))
        return self._fillings[order]

    def _placed(self, order: Order) -> dict[int, Place]:
        sheets: list[Contents] = []
        filled: list[float] = []
        places: dict[int, Place] = {}
        for index in order.pieces:
            for number in _in_turn(filled, order.sheets):
                if number == len(sheets):
                    sheets.append(frozenset())
                    filled.append(0.0)
                spot = self._spot(sheets[number], index)
                if spot is not None:
                    sheets[number] = self._with(sheets[number], index, spot)
                    filled[number] += self.shares[index]
                    places[index] = Place(number, self._turns[index].motion(spot))
                    break
        return places

    def _spot(self, contents: Contents, index: int) -> Spot | None:
        """Where a shape goes on a sheet with these contents."""
        key = contents, index
        if key not in self._fits:
            self._fits[key] = self._fit(contents, index)
        return self._fits[key].spot

    def _fit(self, contents: Contents, index: int) -> Fit:
        turns, sheet = self._turns[index], self._sheets[contents]
        left = self._left(contents, index) if sheet.has_room(turns) else ()
        if not left:
            return Fit(None, ())
        fit = sheet.fit(turns, left, self._spectrum(contents), low=self._low)
        self.effort += (len(left) + len(fit.turns)) * prod(self._grid.padded)
        return fit

    def _left(self, contents: Contents, index: int) -> tuple[int, ...]:
        """Turns of a shape that can still fit: one without a place on a sheet has none when there is more."""
        while contents in self._before:
            contents = self._before[contents]
            if (contents, index) in self._fits:
                return self._fits[contents, index].turns
        return tuple(range(len(self._turns[index].masks)))

    def _with(self, contents: Contents, index: int, spot: Spot) -> Contents:
        """The contents of a sheet and one more shape."""
        more = contents | {(index, spot)}
        if more not in self._sheets:
            self._sheets[more] = self._sheets[contents].taking(spot, self._turns[index])
            self._before[more] = contents
        return more


def _in_turn(filled: Sequence[float], first: First) -> list[int]:
    """Sheets in the order in which a piece tries them, the last one new."""
    numbers = list(range(len(filled)))
    if first is First.NEEDY:
        numbers[:-1] = sorted(numbers[:-1], key=lambda number: filled[number] >= WELL_FILLED)
    if first is First.NEEDIEST:
        numbers[:-1] = sorted(numbers[:-1], key=lambda number: min(filled[number], WELL_FILLED))
    return [*numbers, len(filled)]

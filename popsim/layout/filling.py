"""Filling sheets with pieces in a given order, on rasters of one cell; what was tried once is remembered."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from popsim.geometry.arrays import FloatArray
from popsim.layout.orders import Order
from popsim.layout.sheet_raster import Fit, Grid, SheetRaster, Spot, Turns
from popsim.layout.waste import WELL_FILLED, Waste, waste_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon

Contents = frozenset[tuple[int, Spot]]
"""What lies on a sheet: indices of pieces, and where."""


class Place(NamedTuple):
    """Where a shape goes: index of the sheet, flat motion (3, 3) into the area's coordinates."""

    sheet: int
    motion: FloatArray


class Filling(NamedTuple):
    """Places of all shapes, in their order, and what they waste."""

    waste: Waste
    places: tuple[Place, ...]


class Filler:
    """Fills sheets with the same shapes in one order after another.

    Parameters
    ----------
    angles:
        At which each shape goes onto a sheet, rad.
    room, gap:
        Width and height of the usable area and the least distance between two shapes, mm.
    cell:
        Side of the raster's cells, mm.
    low:
        Put each shape as low as it goes instead of where it fits most snugly: what stays free is in one piece.

    Attributes
    ----------
    shares:
        Of a sheet that each shape takes.
    effort:
        Convolutions so far.
    """

    def __init__(
        self,
        shapes: Sequence["Polygon"],
        angles: Sequence[Sequence[float]],
        room: tuple[float, float],
        gap: float,
        cell: float,
        *,
        low: bool = False,
    ) -> None:
        grid = Grid.over(room, gap, cell)
        self.effort = 0
        self._low = low
        self.shares = tuple(shape.area / (room[0] * room[1]) for shape in shapes)
        self._turns = [Turns.of(shape, own, gap, grid) for shape, own in zip(shapes, angles, strict=True)]
        self._sheets: dict[Contents, SheetRaster] = {frozenset(): SheetRaster.empty(grid)}
        self._before: dict[Contents, Contents] = {}
        self._fits: dict[tuple[Contents, int], Fit] = {}
        self._fillings: dict[Order, Filling] = {}

    def filling(self, order: Order) -> Filling:
        """All shapes on sheets, one after another in an order."""
        if order not in self._fillings:
            places = self._placed(order)
            waste = waste_of(self.shares, [place.sheet for place in places])
            self._fillings[order] = Filling(waste, places)
        return self._fillings[order]

    def _placed(self, order: Order) -> tuple[Place, ...]:
        sheets: list[Contents] = []
        filled: list[float] = []
        places: dict[int, Place] = {}
        for index in order.pieces:
            for number in _in_turn(filled, order.needy):
                if number == len(sheets):
                    sheets.append(frozenset())
                    filled.append(0.0)
                spot = self._spot(sheets[number], index)
                if spot is not None:
                    sheets[number] = self._with(sheets[number], index, spot)
                    filled[number] += self.shares[index]
                    places[index] = Place(number, self._turns[index].motion(spot))
                    break
        return tuple(places[index] for index in range(len(self._turns)))

    def _spot(self, contents: Contents, index: int) -> Spot | None:
        """Where a shape goes on a sheet with these contents."""
        key = contents, index
        if key not in self._fits:
            left = self._left(contents, index)
            self._fits[key] = self._sheets[contents].fit(self._turns[index], left, low=self._low)
            self.effort += len(left) + len(self._fits[key].turns)
        return self._fits[key].spot

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


def _in_turn(filled: Sequence[float], needy: bool) -> list[int]:
    """Sheets in the order in which a piece tries them, the last one new."""
    numbers = list(range(len(filled)))
    if needy:
        numbers[:-1] = sorted(numbers[:-1], key=lambda number: filled[number] >= WELL_FILLED)
    return [*numbers, len(filled)]

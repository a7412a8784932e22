"""Nesting pieces on sheets: first fit on a raster, all places of a sheet tried at once by convolution.

Pieces go largest first, by several measures and with their sizes taken at random within limits; the best result is
kept: fewest sheets, then least on the last. For each piece the sheets are searched in order, and on a sheet the
lowest, then leftmost place of all its turns. The raster covers every piece grown by half the gap and half a cell,
so what is free on the raster is free on paper; shapely has the last word.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from random import Random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.flat import flat_motion, move_shape
from popsim.layout.errors import LayoutError

if TYPE_CHECKING:
    from shapely.geometry import Polygon

CELL = 1.0
"""mm; side of a raster cell."""

SQUARE = 1e-3
"""Radians; a smallest rectangle that is turned by less is upright."""

MEASURES: tuple[Callable[["Polygon"], float], ...] = (
    lambda shape: float(shape.area),
    lambda shape: float(shape.envelope.area),
    lambda shape: float(shape.convex_hull.area),
)
"""Orders that are tried: largest first, by these."""

TRIES = 12
"""Orders tried in all; twice as many save no sheet in any of a dozen designs, and little of the last."""

SMALLEST_SHARE = 0.4
"""In a random order a piece counts as this share of its size at least: large ones still go early."""

Spectrum = npt.NDArray[np.complex128]


class Place(NamedTuple):
    """Where a shape goes: index of the sheet, flat motion (3, 3) into the area's coordinates."""

    sheet: int
    motion: FloatArray


@dataclass(frozen=True, eq=False)
class _Turned:
    """A shape at one angle.

    `motion` brings it to where its `mask` (rows are y) at row and column 0 means; `size` is that of the sheets.
    """

    motion: FloatArray
    mask: BoolArray
    size: tuple[int, int]

    @cached_property
    def cells(self) -> int:
        """Number of cells covered."""
        return int(self.mask.sum())

    @cached_property
    def spectrum(self) -> Spectrum:
        """Spectrum of the mask on a sheet."""
        return _spectrum(self.mask, self.size)


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
    slack = _growth(gap)  # grown shapes may reach over the area's rim
    size = (int((room[1] + 2 * slack) // CELL), int((room[0] + 2 * slack) // CELL))
    turns = [[_turned(shape, angle, gap, size) for angle in _angles(shape, room, grain)] for shape in shapes]
    for index, own in enumerate(turns):
        if not own:
            raise _too_large(shapes[index], names[index], room)
    best: list[Place] = []
    for order in _orders(shapes):
        found = _fill(turns, order, size)
        if not best or _waste(found, shapes) < _waste(best, shapes):
            best = found
    _judge(shapes, names, best, room, gap)
    return _emptiest_last(best, shapes)


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


def _fill(turns: list[list[_Turned]], order: tuple[int, ...], size: tuple[int, int]) -> list[Place]:
    """First fit of all shapes in the given order."""
    sheets: list[_Sheet] = []
    places = {index: _put(turns[index], sheets, size) for index in order}
    return [places[index] for index in range(len(turns))]


def _waste(places: list[Place], shapes: list["Polygon"]) -> tuple[float, ...]:
    """Less is better: number of sheets, what lies on the emptiest, then how evenly the others are filled."""
    filled = _filled(places, shapes)
    return len(filled), float(filled.min(initial=np.inf)), -float((filled**2).sum())


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


def _growth(gap: float) -> float:
    """Half the gap, and the half diagonal of a cell: a cell that a shape touches then has its centre inside."""
    return gap / 2 + CELL * float(np.sqrt(0.5))


class _Sheet:
    """What is taken on a sheet, with its spectrum for convolutions."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.taken: BoolArray = np.zeros(size, dtype=bool)
        self.spectrum: Spectrum | None = None

    def lowest(self, turned: _Turned) -> tuple[int, int] | None:
        """Row and column of the lowest, then leftmost place where the raster of `turned` hits nothing."""
        from scipy import fft

        rows, columns = self.taken.shape[0] - turned.mask.shape[0], self.taken.shape[1] - turned.mask.shape[1]
        if not self.taken.any():
            return 0, 0
        if self.spectrum is None:
            self.spectrum = _spectrum(self.taken, self.taken.shape)
        hits = fft.irfft2(self.spectrum * turned.spectrum.conj(), s=_padded(self.taken.shape))[
            : rows + 1, : columns + 1
        ]
        free = np.argwhere(hits < 0.5)
        return (int(free[0][0]), int(free[0][1])) if len(free) else None

    def take(self, row: int, column: int, mask: BoolArray) -> None:
        self.taken[row : row + mask.shape[0], column : column + mask.shape[1]] |= mask
        self.spectrum = None


def _padded(size: tuple[int, ...]) -> tuple[int, int]:
    from scipy import fft

    return fft.next_fast_len(size[0], real=True), fft.next_fast_len(size[1], real=True)


def _spectrum(mask: BoolArray, size: tuple[int, ...]) -> Spectrum:
    """Spectrum of a raster; circular convolution is exact for places where the raster stays within `size`."""
    from scipy import fft

    return np.asarray(fft.rfft2(mask.astype(np.float64), s=_padded(size)))


def _put(turns: list[_Turned], sheets: list[_Sheet], size: tuple[int, int]) -> Place:
    least = min(turned.cells for turned in turns)
    for number in range(len(sheets) + 1):
        if number == len(sheets):
            sheets.append(_Sheet(size))
        sheet = sheets[number]
        if sheet.taken.size - int(sheet.taken.sum()) < least:
            continue
        spots = [(spot, k) for k, turned in enumerate(turns) if (spot := sheet.lowest(turned)) is not None]
        if spots:
            (row, column), k = min(spots)
            sheet.take(row, column, turns[k].mask)
            return Place(number, flat_motion(0.0, (column * CELL, row * CELL)) @ turns[k].motion)
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


def _turned(shape: "Polygon", angle: float, gap: float, size: tuple[int, int]) -> _Turned:
    """The shape at an angle; what its growth adds beyond the sheet is left out."""
    motion = flat_motion(angle)
    moved = move_shape(motion, shape)
    growth = _growth(gap)
    low = np.array(moved.bounds[:2]) - growth
    columns, rows = np.ceil((np.array(moved.bounds[2:]) + growth - low) / CELL).astype(int)
    # mitred corners hold the round ones, whose polygons would fall short of the full distance
    grown = moved.buffer(growth, join_style="mitre", mitre_limit=1.1)
    mask = _raster(grown, low, (min(int(rows), size[0]), min(int(columns), size[1])))
    return _Turned(flat_motion(0.0, -low - growth) @ motion, mask, size)


def _raster(shape: "Polygon", low: FloatArray, size: tuple[int, int]) -> BoolArray:
    """Cells whose centre lies in `shape`, shape `size` (rows, columns)."""
    import shapely

    shapely.prepare(shape)
    y, x = np.meshgrid(*((np.arange(n) + 0.5) * CELL for n in size), indexing="ij")
    return np.asarray(shapely.contains_xy(shape, x + low[0], y + low[1]))


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

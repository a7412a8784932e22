"""Sheets as rasters: all places of a shape on a sheet tried at once, by convolution.

The raster covers every shape grown by half the gap and half a cell: what is free on the raster is free on paper.
Of all free places the snuggest is taken: the one at which most of the shape's rim lies along others or the edge of
the sheet.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.flat import flat_motion, move_shape
from popsim.geometry.raster import covered

if TYPE_CHECKING:
    from shapely.geometry import Polygon

RIM = 3
"""Cells round a shape in which others count as lying along it."""

Spectra = npt.NDArray[np.complex64]
"""Single precision: a place is free where fewer than half a cell is hit, of at most some 10,000."""


class Grid(NamedTuple):
    """The raster of a sheet: side of a cell in mm, rows and columns."""

    cell: float
    size: tuple[int, int]

    @classmethod
    def over(cls, room: tuple[float, float], gap: float, cell: float) -> "Grid":
        """The raster over an area of this width and height, mm; grown shapes may reach over its rim."""
        slack = growth(gap, cell)
        return cls(cell, (int((room[1] + 2 * slack) // cell), int((room[0] + 2 * slack) // cell)))

    @property
    def padded(self) -> tuple[int, int]:
        """The size with room for rims all round that is fast to transform."""
        from scipy import fft

        rows, columns = (fft.next_fast_len(length + 2 * RIM, real=True) for length in self.size)
        return rows, columns

    def spectrum(self, mask: BoolArray) -> Spectra:
        """Spectrum of a raster; convolution is exact for places within the sheet."""
        from scipy import fft

        return np.asarray(fft.rfft2(mask.astype(np.float32), s=self.padded))

    def hits(self, spectra: Spectra) -> npt.NDArray[np.float32]:
        """Numbers of cells hit at each place, of products of spectra, shape (..., rows, columns)."""
        from scipy import fft

        return np.asarray(fft.irfft2(spectra, s=self.padded))


class Spot(NamedTuple):
    """Where a shape fits: row, column, and which of its turns."""

    row: int
    column: int
    turn: int


class Fit(NamedTuple):
    """The best spot of a shape on a sheet, None where there is none, and the turns that find any."""

    spot: Spot | None
    turns: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Turns:
    """A shape at all angles at which it goes onto a sheet.

    `motions` (3, 3) bring it to where its `masks` (rows are y) at row and column 0 mean.
    """

    grid: Grid
    motions: tuple[FloatArray, ...]
    masks: tuple[BoolArray, ...]

    @classmethod
    def of(cls, shape: "Polygon", angles: Sequence[float], gap: float, grid: Grid) -> "Turns":
        """The shape at these angles, without those at which it covers the same cells once more."""
        found: dict[tuple[object, ...], tuple[FloatArray, BoolArray]] = {}
        for motion, mask in (_turned(shape, angle, gap, grid) for angle in angles):
            found.setdefault((mask.shape, mask.tobytes()), (motion, mask))
        return cls(grid, *map(tuple, zip(*found.values(), strict=True)))

    @cached_property
    def cells(self) -> int:
        """Least number of cells covered."""
        return min(int(mask.sum()) for mask in self.masks)

    @cached_property
    def against(self) -> Spectra:
        """Conjugate spectra of the masks on a sheet."""
        return np.stack([self.grid.spectrum(mask).conj() for mask in self.masks])

    @cached_property
    def rims(self) -> tuple[BoolArray, ...]:
        """The cells round each mask, with RIM more rows and columns on each side."""
        from scipy.ndimage import binary_dilation

        padded = [np.pad(mask, RIM) for mask in self.masks]
        return tuple(binary_dilation(mask, iterations=RIM) & ~mask for mask in padded)

    @cached_property
    def along(self) -> Spectra:
        """Conjugate spectra of the rims."""
        return np.stack([self.grid.spectrum(rim).conj() for rim in self.rims])

    def motion(self, spot: Spot) -> FloatArray:
        """Flat motion (3, 3) from the shape into the area's coordinates."""
        return (
            flat_motion(0.0, (spot.column * self.grid.cell, spot.row * self.grid.cell)) @ self.motions[spot.turn]
        )


@dataclass(frozen=True, eq=False)
class SheetRaster:
    """What is taken on a sheet, shape (rows, columns)."""

    grid: Grid
    taken: BoolArray

    @classmethod
    def empty(cls, grid: Grid) -> "SheetRaster":
        """A sheet with nothing on it."""
        return cls(grid, np.zeros(grid.size, dtype=bool))

    @cached_property
    def free(self) -> int:
        """Number of cells that are not taken."""
        return self.taken.size - int(self.taken.sum())

    def has_room(self, turns: Turns) -> bool:
        """Whether as many cells are free as the shape covers."""
        return self.free >= turns.cells

    def spectrum(self) -> Spectra:
        """Of what is taken, and of RIM more cells on each side, where nothing may be put."""
        return self.grid.spectrum(np.pad(self.taken, RIM, constant_values=True))

    def fit(self, turns: Turns, among: Sequence[int], around: Spectra, *, low: bool) -> Fit:
        """The snuggest place where one of these turns of the shape hits nothing; or, if `low`, the lowest.

        `around` is the sheet's :meth:`spectrum`.
        """
        hits = self.grid.hits(around * turns.against[list(among)])[:, RIM:, RIM:]
        found: list[tuple[float, int, int, Spot]] = []
        for k, hit in zip(among, hits, strict=True):
            height, width = turns.masks[k].shape
            rows, columns = self.grid.size[0] - height + 1, self.grid.size[1] - width + 1
            free, snug = hit[:rows, :columns] < 0.5, 0.0
            if not free.any():
                continue
            if low:
                row, column = divmod(int(free.argmax()), columns)
            else:
                touched = np.round(self.grid.hits(around * turns.along[k])[:rows, :columns])
                row, column = divmod(int(np.where(free, touched, -1).argmax()), columns)
                snug = round(float(touched[row, column]) / int(turns.rims[k].sum()), 3)
            found.append((-snug, row + height, column + width, Spot(row, column, k)))
        return Fit(min(found)[-1] if found else None, tuple(spot.turn for *_, spot in found))

    def taking(self, spot: Spot, turns: Turns) -> "SheetRaster":
        """The sheet with a shape put there."""
        mask, taken = turns.masks[spot.turn], self.taken.copy()
        taken[spot.row : spot.row + mask.shape[0], spot.column : spot.column + mask.shape[1]] |= mask
        return SheetRaster(self.grid, taken)


def growth(gap: float, cell: float) -> float:
    """Half the gap, and the half diagonal of a cell: a cell that a shape touches then has its centre inside."""
    return gap / 2 + cell * float(np.sqrt(0.5))


def _turned(shape: "Polygon", angle: float, gap: float, grid: Grid) -> tuple[FloatArray, BoolArray]:
    """Motion and mask of the shape at an angle; what its growth adds beyond the sheet is left out."""
    motion = flat_motion(angle)
    moved = move_shape(motion, shape)
    grown_by = growth(gap, grid.cell)
    low = np.array(moved.bounds[:2]) - grown_by
    columns, rows = np.ceil((np.array(moved.bounds[2:]) + grown_by - low) / grid.cell).astype(int)
    # mitred corners hold the round ones, whose polygons would fall short of the full distance
    with np.errstate(divide="ignore", invalid="ignore"):  # GEOS divides by zero at spikes, and copes
        grown = moved.buffer(grown_by, join_style="mitre", mitre_limit=1.1)
    size = min(int(rows), grid.size[0]), min(int(columns), grid.size[1])
    return flat_motion(0.0, -low - grown_by) @ motion, covered(grown, low, grid.cell, size)[::-1]

"""Sheets as rasters: all places of a shape on a sheet tried at once, by convolution.

The raster covers every shape grown by half the gap and half a cell: what is free on the raster is free on paper.
"""

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
        """A size that is fast to transform."""
        from scipy import fft

        return fft.next_fast_len(self.size[0], real=True), fft.next_fast_len(self.size[1], real=True)

    def spectra(self, masks: npt.NDArray[np.float32]) -> Spectra:
        """Spectra of rasters (k, rows, columns); convolution is exact for places within the sheet."""
        from scipy import fft

        return np.asarray(fft.rfft2(masks, s=self.padded))


class Spot(NamedTuple):
    """Where a shape fits: row, column, and which of its turns; the lowest, then leftmost comes first."""

    row: int
    column: int
    turn: int


@dataclass(frozen=True, eq=False)
class Turns:
    """A shape at all angles at which it goes onto a sheet.

    `motions` (3, 3) bring it to where its `masks` (rows are y) at row and column 0 mean.
    """

    grid: Grid
    motions: tuple[FloatArray, ...]
    masks: tuple[BoolArray, ...]

    @classmethod
    def of(cls, shape: "Polygon", angles: list[float], gap: float, grid: Grid) -> "Turns":
        """The shape at these angles."""
        found = [_turned(shape, angle, gap, grid) for angle in angles]
        return cls(grid, tuple(motion for motion, _ in found), tuple(mask for _, mask in found))

    @cached_property
    def cells(self) -> int:
        """Least number of cells covered."""
        return min(int(mask.sum()) for mask in self.masks)

    @cached_property
    def against(self) -> Spectra:
        """Conjugate spectra of the masks on a sheet."""
        padded = np.zeros((len(self.masks), *self.grid.size), dtype=np.float32)
        for k, mask in enumerate(self.masks):
            padded[k, : mask.shape[0], : mask.shape[1]] = mask
        return self.grid.spectra(padded).conj()

    def motion(self, spot: Spot) -> FloatArray:
        """Flat motion (3, 3) from the shape into the area's coordinates."""
        return (
            flat_motion(0.0, (spot.column * self.grid.cell, spot.row * self.grid.cell)) @ self.motions[spot.turn]
        )


class SheetRaster:
    """What is taken on a sheet, with its spectrum for convolutions."""

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        self.taken: BoolArray = np.zeros(grid.size, dtype=bool)
        self.spectrum: Spectra | None = None
        self.free = self.taken.size

    def lowest(self, turns: Turns) -> Spot | None:
        """The first place where a turn of the shape hits nothing."""
        from scipy import fft

        if self.free == self.taken.size:
            return Spot(0, 0, 0)
        if self.free < turns.cells:
            return None
        if self.spectrum is None:
            self.spectrum = self.grid.spectra(self.taken[None].astype(np.float32))
        hits = fft.irfft2(self.spectrum * turns.against, s=self.grid.padded)
        spots = []
        for k, mask in enumerate(turns.masks):
            rows, columns = self.grid.size[0] - mask.shape[0] + 1, self.grid.size[1] - mask.shape[1] + 1
            free = (hits[k, :rows, :columns] < 0.5).ravel()
            if (first := int(free.argmax())) or free[0]:
                spots.append(Spot(first // columns, first % columns, k))
        return min(spots, default=None)

    def take(self, spot: Spot, turns: Turns) -> None:
        """Put a shape there."""
        mask = turns.masks[spot.turn]
        self.taken[spot.row : spot.row + mask.shape[0], spot.column : spot.column + mask.shape[1]] |= mask
        self.free = self.taken.size - int(self.taken.sum())
        self.spectrum = None


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
    grown = moved.buffer(grown_by, join_style="mitre", mitre_limit=1.1)
    size = min(int(rows), grid.size[0]), min(int(columns), grid.size[1])
    return flat_motion(0.0, -low - grown_by) @ motion, covered(grown, low, grid.cell, size)[::-1]

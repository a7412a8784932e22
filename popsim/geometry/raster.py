"""Shapes on a raster: which pixels have their centres inside."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


def covered(shape: "BaseGeometry", low: FloatArray, pixel: float, size: tuple[int, int]) -> BoolArray:
    """Return the pixels whose centres lie inside `shape`, shape `size`; row 0 is the upper one.

    Every edge turns the pixels to its right from outside to inside or back, so that holes need no care; a tenth of
    the time of asking for each pixel.

    Parameters
    ----------
    shape:
        Polygons that do not overlap.
    low:
        Lower left corner of the raster, shape (2,).
    pixel:
        Side of a pixel, in the unit of the shape.
    size:
        Rows and columns.
    """
    rows, columns = size
    start, end = (ends / pixel - 0.5 for ends in _edges(shape, low))  # centres are whole numbers
    first, last = (
        np.clip(np.ceil(far(start[:, 1], end[:, 1])), 0, rows).astype(np.int64) for far in (np.minimum, np.maximum)
    )
    count = last - first
    edge = np.repeat(np.arange(len(count)), count)
    row = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count) + first[edge]
    slope = (end[edge, 0] - start[edge, 0]) / (end[edge, 1] - start[edge, 1])
    crossing = start[edge, 0] + (row - start[edge, 1]) * slope
    column = np.clip(np.ceil(crossing), 0, columns).astype(np.int64)
    turns = np.bincount(row * (columns + 1) + column, minlength=rows * (columns + 1)).astype(np.uint8)
    inside = np.bitwise_xor.accumulate(turns.reshape(rows, columns + 1)[:, :columns] & 1, axis=1)
    return np.asarray(inside[::-1], dtype=bool)


def _edges(shape: "BaseGeometry", low: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Starts and ends of all edges from `low`, shape (n, 2) each."""
    import shapely

    rings = shapely.get_rings(shapely.get_parts(shape))
    points, ring = shapely.get_coordinates(rings, return_index=True)
    along = ring[1:] == ring[:-1]
    relative = points - low
    return relative[:-1][along], relative[1:][along]

"""Which corners of triangles are the same point."""

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray, IntArray

SPREAD = np.uint64(0x9E3779B97F4A7C15)
"""Odd, and near 2^64 over the golden ratio: multiples of it lie far apart."""


def corner_numbers(triangles: FloatArray) -> IntArray:
    """Return a number per corner, shape (m, 3), the same for corners at exactly the same point.

    Parameters
    ----------
    triangles:
        Corners, shape (m, 3, 3).

    The numbers are 0 .. k - 1, in no order that means anything. (`numpy.unique` by rows takes ten times as long.)
    """
    points = triangles.reshape(-1, 3)
    key = mixed(np.ascontiguousarray((points + 0.0).T).view(np.uint64))  # + 0.0: there is one zero only
    order = np.argsort(key, kind="stable")
    number, places = _numbered(order, key[order]), points[order]
    if (places[1:] != places[:-1])[np.diff(number[order]) == 0].any():  # two points with one key
        order = np.lexsort(points.T)
        number = _numbered(order, *points[order].T)
    return number.reshape(-1, 3)


def mixed(words: npt.NDArray[np.uint64]) -> npt.NDArray[np.uint64]:
    """Return a key for each column of words (k, n), shape (n,): the same for the same words, hardly for others."""
    key = np.zeros(words.shape[1], dtype=np.uint64)
    for row in words:
        key += row
        key *= SPREAD
        key ^= key >> np.uint64(32)
    return key


def _numbered(order: IntArray, *columns: npt.NDArray[np.float64 | np.uint64]) -> IntArray:
    """Number what `order` brings together; it counts as one where all columns, in this order, are the same."""
    new = np.zeros(len(order), dtype=bool)
    for column in columns:
        new[1:] |= column[1:] != column[:-1]
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.cumsum(new)
    return number


NEAR_BITS = 20
"""Corners are welded on a grid of 2^20 steps along the longest side: a millionth of it."""


def near_corner_numbers(triangles: FloatArray) -> IntArray:
    """Return a number per corner, shape (m, 3), the same for corners on one step of a fine grid over all.

    For meshes whose corners were rounded one by one. Two corners that are nearly one may still be told apart where
    a border of the grid runs between them.
    """
    points = triangles.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    size = max(float((high - low).max()), 1e-300)
    cells = np.round((points - low) / size * 2**NEAR_BITS).astype(np.int64)
    key = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
    numbers: IntArray = np.unique(key, return_inverse=True)[1].reshape(-1, 3)
    return numbers

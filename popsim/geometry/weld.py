"""Which corners of triangles are the same point."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray


def corner_numbers(triangles: FloatArray) -> IntArray:
    """Return a number per corner, shape (m, 3), the same for corners at exactly the same point.

    Parameters
    ----------
    triangles:
        Corners, shape (m, 3, 3).

    The numbers are 0 .. k - 1, by z, then y, then x. (`numpy.unique` by rows takes four times as long.)
    """
    points = triangles.reshape(-1, 3)
    order = np.lexsort(points.T)
    ordered = points[order]
    new = np.ones(len(points), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    number = np.empty(len(points), dtype=np.int64)
    number[order] = np.cumsum(new) - 1
    return number.reshape(-1, 3)

"""Gains of roofs on a spot (:mod:`popsim.fitting.roofs`)."""

import numpy as np

from popsim.fitting.kernels.compiled import compiled
from popsim.geometry.arrays import FloatArray, IntArray


@compiled
def gains(across: FloatArray, reach: IntArray, heights: IntArray) -> FloatArray:
    """What each column of a roof gains, by half base and height.

    Parameters
    ----------
    across:
        Gain of the first cells along u, by column, their number and level, shape (columns, widths + 1, levels).
    reach:
        Cells along u inside a roof, by half base, height and level, shape (t, h, levels).
    heights:
        The heights, in cells, shape (h,).

    Returns
    -------
    numpy.ndarray
        Shape (columns, t, h).
    """
    found = np.zeros((across.shape[0], reach.shape[0], reach.shape[1]))
    for column in range(across.shape[0]):
        own = across[column]
        for half in range(reach.shape[0]):
            for height in range(reach.shape[1]):
                inside = reach[half, height]
                total = 0.0
                for level in range(min(heights[height], own.shape[1])):
                    total += own[inside[level], level]
                found[column, half, height] = total
    return found

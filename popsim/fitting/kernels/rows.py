"""Profiles over a spot (:mod:`popsim.fitting.rows`)."""

import numpy as np

from popsim.fitting.kernels.compiled import compiled
from popsim.geometry.arrays import FloatArray


@compiled
def with_later(sums: FloatArray, trust: float, share: float) -> FloatArray:
    """Gains of boxes with what one more box could gain on each.

    Parameters
    ----------
    sums:
        Gain of a box by column, width and height, shape (columns, widths, heights).
    trust:
        How much of the latter counts.
    share:
        What that box costs in each column.
    """
    columns, widths, heights = sums.shape
    found, best = np.empty(sums.shape), np.empty(heights)
    for x in range(columns):
        best[:] = -np.inf
        for w in range(widths):
            own, new, highest = sums[x, w], found[x, w], -np.inf
            for h in range(heights - 1, -1, -1):
                highest = max(highest, own[h])
                best[h] = max(best[h], highest - own[h])
                new[h] = own[h] + trust * max(best[h] - share, 0.0)
    return found


@compiled
def profiles(value: FloatArray, step: FloatArray, outside: float) -> FloatArray:
    """Best values of profiles that first rise and then fall and end in each column at each height.

    Parameters
    ----------
    value:
        Of each column, width and height, shape (columns, widths, heights).
    step:
        Price of a step up, and of one down, at the low end of each column, shape (2, columns).
    outside:
        Value of what cannot be.

    Returns
    -------
    numpy.ndarray
        By column, phase (0 rises, 1 has begun to fall), width and height, shape (columns, 2, widths, heights).
    """
    columns, widths, heights = value.shape
    best = np.full((columns, 2, widths, heights), outside)
    best[0, 0] = value[0]
    for x in range(1, columns):
        for w in range(widths):
            rising, falling, own = best[x - 1, 0, w], best[x - 1, 1, w], value[x, w]
            grown, fallen = best[x, 0, w], best[x, 1, w]
            highest = -np.inf
            for h in range(heights):
                grown[h] = max(rising[h], 0.0, highest - step[0, x]) + own[h]
                highest = max(highest, rising[h])
            highest = -np.inf
            for h in range(heights - 1, -1, -1):
                fallen[h] = max(falling[h], highest - step[1, x]) + own[h]
                highest = max(highest, rising[h], falling[h])
    return best

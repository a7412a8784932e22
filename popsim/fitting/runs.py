"""The stretch of columns with the greatest sum."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray


def best_run(values: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
    """Greatest sum over consecutive entries of the first axis, for each entry of the others.

    Returns
    -------
    tuple
        The sum, its first index and the index after its last, each of shape `values.shape[1:]`.
    """
    zero = np.zeros((1, *values.shape[1:]))
    total = np.concatenate([zero, values.cumsum(axis=0)])
    lowest = np.minimum.accumulate(total, axis=0)
    index = np.arange(len(total)).reshape(-1, *[1] * (values.ndim - 1))
    lowest_at = np.maximum.accumulate(np.where(total <= lowest, index, 0), axis=0)
    gain = total - lowest
    last = gain.argmax(axis=0)
    first = np.take_along_axis(lowest_at, last[None], axis=0)[0]
    return np.take_along_axis(gain, last[None], axis=0)[0], first, last

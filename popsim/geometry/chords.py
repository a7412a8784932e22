"""Where a line in a plane runs over an area: a fraction of the time of a general overlay."""

from collections.abc import Iterable

import numpy as np

from popsim.geometry.arrays import FloatArray


def edges_of(rings: Iterable[FloatArray]) -> FloatArray:
    """All edges of rings (n, 2), none of which repeats its first point, shape (m, 2, 2)."""
    return np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])


def chords(edges: FloatArray, line: FloatArray) -> FloatArray:
    """Stretches of an endless line that lie inside an area, in their order.

    Parameters
    ----------
    edges:
        Of the outline and of all holes of the area, shape (m, 2, 2).
    line:
        Two points of the line, shape (2, 2).

    Returns
    -------
    Start and end of each stretch, mm from the first point towards the second, shape (k, 2). An edge on the line
    itself counts as lying to its right.
    """
    along = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    rel = edges - line[0]
    height = rel @ np.array([-along[1], along[0]])
    crossing = (height[:, 0] > 0) != (height[:, 1] > 0)
    first, second = height[crossing].T
    start, end = (rel[crossing] @ along).T
    return np.asarray(np.sort(start + (end - start) * first / (first - second)).reshape(-1, 2))


def shared(one: FloatArray, other: FloatArray) -> FloatArray:
    """What stretches of a line (k, 2) and others (m, 2) have in common, shape (n, 2)."""
    low = np.maximum(one[:, None, 0], other[None, :, 0]).ravel()
    high = np.minimum(one[:, None, 1], other[None, :, 1]).ravel()
    return np.stack([low, high], axis=1)[low < high]

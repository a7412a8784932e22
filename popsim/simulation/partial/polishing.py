"""Newton's method with damping: what is left of gaps where steps of the integration close ever less of them."""

from collections.abc import Callable

import numpy as np

from popsim.geometry.arrays import FloatArray

STEPS = 40
"""Steps at most."""

BOLDER, MORE_CAREFUL = 0.1, 20.0
"""Factors on the damping after a step that made errors smaller, and after one that did not and is undone."""

FLOOR = 1e-13
"""Least damping: above rounding."""

DONE = 1e-9
"""Errors over the size of the structure that need no more."""


def polished(
    angles: FloatArray,
    errors: Callable[[FloatArray], FloatArray],
    slopes: Callable[[], FloatArray],
) -> FloatArray:
    """Angles (j,) near some others at which errors are least; what does not make them smaller is undone.

    Parameters
    ----------
    angles:
        Where to begin, rad, shape (j,).
    errors:
        Takes joints to angles (j,) and tells the errors there, in units of the model, shape (e,).
    slopes:
        How errors answer to the joints where they were last asked for, per rad, shape (e, j).
    """
    damping, best = 1.0, errors(angles)
    matrix = None
    for _ in range(STEPS):
        if np.abs(best).max(initial=0.0) < DONE:
            break
        matrix = slopes() if matrix is None else matrix
        normal = matrix.T @ matrix + (damping * np.linalg.norm(best) + FLOOR) * np.eye(matrix.shape[1])
        tried = angles - np.linalg.solve(normal, matrix.T @ best)
        now = errors(tried)
        if np.linalg.norm(now) < np.linalg.norm(best):
            angles, best, matrix, damping = tried, now, None, damping * BOLDER
        else:
            damping *= MORE_CAREFUL
    errors(angles)
    return angles

"""Legs in what a plate shows of the model, as contours will leave them out (:mod:`popsim.rendering.set_back`)."""

import numpy as np

from popsim.fitting.masks import parts
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import Plate
from popsim.rendering.set_back import SET_BACK, Face, is_leg

ACROSS = 0.99
"""|cos| of a normal to x above which a plate stands across the fold: there it hangs between the sides of its
mechanism, since no hinge on the ground could turn it."""

LEAST = 2
"""Cells; smaller parts belong to their neighbours."""


def legs(plate: Plate, behind: FloatArray, shown: BoolArray, inside: BoolArray) -> BoolArray:
    """Cells of a stencil that show parts standing back beneath nearer ones.

    Parameters
    ----------
    plate:
        The plate.
    behind:
        How deep behind it the model lies, mm, shape (n, m), the second axis upward.
    shown, inside:
        Where that is near enough to show, and what the face covers, shape (n, m).
    """
    found = np.zeros(shown.shape, dtype=bool)
    if not plate.principal or abs(plate.outward[0]) < ACROSS:
        return found
    deep = shown & (behind > SET_BACK * plate.behind)
    if not deep.any():
        return found
    depth = np.where(shown, behind, np.inf).T[::-1]
    face = _face(inside.T[::-1])
    count, labels = parts(deep)
    for label in range(1, count):
        part = labels == label
        if np.count_nonzero(part) >= LEAST and is_leg(part.T[::-1], depth, face):
            found |= part
    return found


def _face(inside: BoolArray) -> Face:
    """Where a face lies, the upper row first."""
    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    return Face(float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1))

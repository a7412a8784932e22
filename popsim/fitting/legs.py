"""Legs in what a plate shows of the model, as contours will leave them out (:mod:`popsim.rendering.set_back`)."""

import numpy as np

from popsim.fitting.masks import parts
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import Plate
from popsim.rendering.set_back import SET_BACK, Face, legs_among

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
    nothing = np.zeros(shown.shape, dtype=bool)
    if not plate.principal or abs(plate.outward[0]) < ACROSS:
        return nothing
    deep = shown & (behind > SET_BACK * plate.behind)
    if not deep.any():
        return nothing
    depth = np.where(shown, behind, np.inf).T[::-1]
    labels = parts(deep)[1].T[::-1]
    found = legs_among(labels, depth, _face(inside.T[::-1]), lambda part: bool(part.sum() >= LEAST))
    return np.ascontiguousarray(found[::-1].T)


def _face(inside: BoolArray) -> Face:
    """Where a face lies, the upper row first."""
    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    return Face(float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1))

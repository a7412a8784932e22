"""Strips of a face that will reach for its hinges where the model does not (see :mod:`popsim.patches.hold`)."""

import numpy as np

from popsim.fitting.lines import lines_among
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.stock import HINGE_LENGTH, NEAR_EDGE, least_hold


def add_strips(shown: BoolArray, lines: FloatArray, low: FloatArray, grain: FloatArray, inside: BoolArray) -> None:
    """Add to what a face shows the strips without which its hinges would not hold.

    Each line along an edge of the face needs a share of its length. What shows nearest to it is joined first, and
    of what is equally near that beside what reaches it already.

    Parameters
    ----------
    shown:
        Cells in which the face shows the model, shape (n, m); changed.
    lines:
        Ends of hinges in the coordinates of the cells, mm, shape (k, 2, 2).
    low, grain:
        Corner where the cells start and their sides, mm, each of shape (2,).
    inside:
        Cells in the face, shape (n, m).
    """
    for _, line in lines_among(lines, low, grain, inside):
        _hold(line.inward(shown), line.inward(inside), float(grain[line.along]))


def _hold(cells: BoolArray, face: BoolArray, side: float) -> None:
    """Hold a line by what shows and what the face has, by place along the line and distance from it."""
    needed = int(np.ceil(least_hold(len(cells), least=HINGE_LENGTH / side)))
    seam = max(round(NEAR_EDGE / side), 1)
    if seam < cells.shape[1] and np.count_nonzero(cells[:, seam]) >= needed:
        return
    deep = _depths(cells, seam)
    if np.count_nonzero(deep == 0) >= needed:
        return
    nearest = np.lexsort((_aside(deep), deep))[:needed]
    cells[nearest] |= face[nearest] & (np.arange(cells.shape[1]) < deep[nearest][:, None])


def _depths(cells: BoolArray, seam: int) -> IntArray:
    """How far from the line each place (n, depth) shows more than a seam along it; `depth` where nothing."""
    beyond = cells[:, seam:]
    found = np.where(beyond.any(axis=1), beyond.argmax(axis=1) + seam, np.where(cells[:, 0], 0, cells.shape[1]))
    return np.where(found <= seam, 0, found)


def _aside(deep: IntArray) -> IntArray:
    """How many places each of some (n,) is from the nearest of least depth, shape (n,)."""
    apart = np.abs(np.arange(len(deep))[:, None] - np.flatnonzero(deep == deep.min()))
    return np.asarray(apart.min(axis=1))

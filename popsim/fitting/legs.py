"""Legs in what a plate shows of the model, as contours will leave them out (:mod:`popsim.rendering.set_back`)."""

import numpy as np

from popsim.fitting.kernels.records import Held
from popsim.fitting.shape import Shape
from popsim.geometry.arrays import BoolArray, IntArray
from popsim.rendering.opencv import opencv
from popsim.rendering.set_back import SET_BACK, Face, legs_among

ACROSS = 0.99
"""|cos| of a normal to x above which a plate stands across the fold: there it hangs between the sides of its
mechanism, since no hinge on the ground could turn it."""

LEAST = 2
"""Cells; smaller parts belong to their neighbours."""


def may_have_legs(plate: Shape, deepest: float) -> bool:
    """Whether a plate may show any, where what it shows lies at most so deep behind it, mm."""
    return deepest > SET_BACK * plate.behind and plate.principal and abs(plate.outward[0]) >= ACROSS


def legs(plate: Shape, own: Held) -> BoolArray | None:
    """Cells of a plate that may have legs, held against a model, that show such; None for none.

    The second axis of the cells leads upward.
    """
    shown = own.face | own.beyond
    deep = shown & (own.behind > SET_BACK * plate.behind)
    depth = np.where(shown, own.behind, np.inf).T[::-1]
    labels = _parts(deep).T[::-1]
    found = legs_among(labels, depth, _face(own.inside.T[::-1]), lambda part: bool(part.sum() >= LEAST))
    return np.ascontiguousarray(found[::-1].T) if found.any() else None


def _parts(mask: BoolArray) -> IntArray:
    """Parts of a mask that hang together by the sides of cells, by number; 0 for the rest."""
    labels: IntArray = opencv().connectedComponents(mask.view(np.uint8), connectivity=4)[1]
    return labels


def _face(inside: BoolArray) -> Face:
    """Where a face lies, the upper row first."""
    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    return Face(float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1))

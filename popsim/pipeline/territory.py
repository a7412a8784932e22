"""Which part of the model each mechanism shows."""

from collections.abc import Sequence

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Mechanism, PairKind

ROUND = 3.0
"""mm; how far what belongs to a mechanism may lie outside its faces where something else begins."""


def territories(mechanisms: Sequence[Mechanism], bounds: FloatArray) -> dict[str, FloatArray]:
    """Box of space of each mechanism, rows low and high, shape (2, 3), mm, by id.

    A mechanism owns everything around its faces up to the model's bounds (2, 3), except where another one
    begins: a neighbour on the same owner (the middle between them), the top it stands on, or the corner that a
    step fills. What stands on its own tops stays: below it the tops are solid.
    """
    space = np.array([bounds[0] - 10 * ROUND, bounds[1] + 10 * ROUND])
    return {mechanism.id: _territory(mechanism, mechanisms, space) for mechanism in mechanisms}


def _territory(mechanism: Mechanism, mechanisms: Sequence[Mechanism], space: FloatArray) -> FloatArray:
    faces = mechanism.face_box()
    box = space.copy()
    pair = mechanism.pair
    box[0, 2] = pair.v if pair.v > 0 else space[0, 2]
    if pair.owner is not None:
        box[:, 0] = max(space[0, 0], pair.x[0] - ROUND), min(space[1, 0], pair.x[1] + ROUND)
    if pair.kind is PairKind.CORNER:
        sides = (pair.u, space[1, 1]) if pair.side.value > 0 else (space[0, 1], -pair.u)
        box[:, 1] = sides
        box[1, 2] = faces[1, 2] + ROUND
        box[:, 0] = faces[0, 0] - ROUND, faces[1, 0] + ROUND
    for other in mechanisms:
        if other is not mechanism and other.pair.owner == pair.owner and other.pair.kind is pair.kind:
            _part(box, faces, other.face_box())
    return box


def _part(box: FloatArray, own: FloatArray, other: FloatArray) -> None:
    """End a box halfway to a neighbour that lies before or behind it along x."""
    if other[0, 0] >= own[1, 0]:
        box[1, 0] = min(box[1, 0], (own[1, 0] + other[0, 0]) / 2)
    elif other[1, 0] <= own[0, 0]:
        box[0, 0] = max(box[0, 0], (own[0, 0] + other[1, 0]) / 2)

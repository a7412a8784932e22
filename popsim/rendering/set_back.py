"""What stands back beneath a plate that ends above the ground: wheels behind a bumper, an axle, legs of a table.

Such a plate shows what lies near its plane, and what goes on from there without a step. What lies beneath an
overhang of it and a step behind would dangle from it as legs do, in front of where the model has them.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray

SET_BACK = 0.75
"""Share of the depth that a plate shows from which on a part of the model stands back. Wheels a little behind
their bumper are part of a vehicle's front: without them its silhouette from there is up to a tenth worse."""

STEP = 1.0
"""mm; depth by which a surface may leave its course and still go on."""

OVERHUNG = 0.5
"""Share of the upper ends of a part above which something nearer must lie."""

WALL = 0.5
"""Share of the height of its plate from which on a part is a wall; of the width, where it reaches the foot."""

FOOT = 2
"""Pixels within which a part reaches the foot."""


class Face(NamedTuple):
    """Where the face of a plate lies in a picture, in pixels from its upper left corner."""

    left: float
    top: float
    right: float
    bottom: float


def legs_among(
    labels: npt.NDArray[np.signedinteger[Any]], depth: FloatArray, face: Face, counts: Callable[[BoolArray], bool]
) -> BoolArray:
    """Pixels of those parts of what a plate shows that stand back beneath something nearer, and are no walls.

    Parameters
    ----------
    labels:
        Parts by number, 0 for the rest, the upper row first, shape (rows, columns).
    depth:
        How deep behind the plate the model lies, mm, inf where it does not show, shape (rows, columns).
    face:
        Of the plate.
    counts:
        Whether a part, as its pixels, is to be considered at all.
    """
    found = np.zeros(labels.shape, dtype=bool)
    for label in range(1, int(labels.max(initial=0)) + 1):
        part = labels == label
        if counts(part) and _overhung(part, depth) and not _wall(part, face):
            found |= part
    return found


def _overhung(part: BoolArray, depth: FloatArray) -> bool:
    """Whether something nearer lies above most of the upper ends of a part."""
    columns = np.flatnonzero(part.any(axis=0))
    top = part[:, columns].argmax(axis=0)
    nearest = np.minimum.accumulate(depth[:, columns], axis=0)
    above = np.where(top > 0, nearest[top - 1, np.arange(len(columns))], np.inf)
    return bool((above < depth[top, columns] - STEP).mean() > OVERHUNG)


def _wall(part: BoolArray, face: Face) -> bool:
    """Whether a part is half as high as the face, or reaches its foot and is half as wide."""
    rows = np.flatnonzero(part.any(axis=1))
    wide = rows[-1] + 1 > face.bottom - FOOT and part.sum() / len(rows) >= WALL * (face.right - face.left)
    return bool(wide or len(rows) >= WALL * (face.bottom - face.top))

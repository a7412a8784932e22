"""What stands back beneath a plate that ends above the ground: wheels behind a bumper, an axle, legs of a table.

Such a plate shows what lies near its plane, and what goes on from there without a step. What lies beneath an
overhang of it and a step behind would dangle from it as legs do, in front of where the model has them.
"""

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.patches.piece import Piece
from popsim.patches.sight import Sight
from popsim.rendering.segmentation import label_map

SET_BACK = 0.75
"""Share of the depth `behind` from which on a part of the model stands back. Wheels a little behind their bumper
are part of a vehicle's front: without them its silhouette from there is up to a tenth worse."""

STEP = 1.0
"""mm; depth by which a surface may leave its quadratic course and still go on."""

LEAST = 2.0
"""mm^2; smaller parts belong to their neighbours."""

OVERHUNG = 0.5
"""Share of the upper ends of a part above which something nearer must lie."""

WALL = 0.5
"""Share of the height of its plate from which on a part is a wall; of the width, where it reaches the foot."""


def legs(sight: Sight, piece: Piece) -> BoolArray:
    """Pixels that show parts standing back beneath nearer ones, shape (rows, columns)."""
    found = np.zeros(sight.mask.shape, dtype=bool)
    back = SET_BACK * piece.plate.behind
    if not (sight.mask & (sight.depth > back)).any():
        return found
    depth = np.where(sight.mask, sight.depth, np.inf)
    labels = label_map(sight.mask, [(sight.depth, STEP)], LEAST / sight.grid.pixel**2)
    for label in range(1, int(labels.max(initial=0)) + 1):
        part = labels == label
        if np.median(depth[part]) > back and _overhung(part, depth) and not _wall(part, sight, piece):
            found |= part
    return found


def _overhung(part: BoolArray, depth: FloatArray) -> bool:
    """Whether something nearer lies above most of the upper ends of a part."""
    columns = np.flatnonzero(part.any(axis=0))
    top = part[:, columns].argmax(axis=0)
    nearest = np.minimum.accumulate(depth[:, columns], axis=0)
    above = np.where(top > 0, nearest[top - 1, np.arange(len(columns))], np.inf)
    return bool((above < depth[top, columns] - STEP).mean() > OVERHUNG)


def _wall(part: BoolArray, sight: Sight, piece: Piece) -> bool:
    """Whether a part is half as high as the plate, or reaches its foot and is half as wide."""
    left, lower, right, upper = piece.face.bounds
    rows = np.flatnonzero(part.any(axis=1))
    pixel = sight.grid.pixel
    foot = sight.grid.low[1] + (sight.grid.shape[0] - rows[-1] - 1) * pixel
    width, height = part.sum() / len(rows) * pixel, len(rows) * pixel
    wide = foot < lower + 2 * pixel and width >= WALL * (right - left)
    return bool(wide or height >= WALL * (upper - lower))

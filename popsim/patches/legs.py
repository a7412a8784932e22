"""Legs in what a plate sees of the model; see :mod:`popsim.rendering.set_back`."""

import numpy as np

from popsim.geometry.arrays import BoolArray
from popsim.patches.piece import Piece
from popsim.patches.sight import Sight
from popsim.rendering.segmentation import label_map
from popsim.rendering.set_back import SET_BACK, STEP, Face, is_leg

LEAST = 2.0
"""mm^2; smaller parts belong to their neighbours."""


def legs(sight: Sight, piece: Piece) -> BoolArray:
    """Pixels that show parts standing back beneath nearer ones, shape (rows, columns)."""
    found = np.zeros(sight.mask.shape, dtype=bool)
    back = SET_BACK * piece.plate.behind
    if not (sight.mask & (sight.depth > back)).any():
        return found
    depth = np.where(sight.mask, sight.depth, np.inf)
    labels = label_map(sight.mask, [(sight.depth, STEP)], LEAST / sight.grid.pixel**2)
    face = _face(sight, piece)
    for label in range(1, int(labels.max(initial=0)) + 1):
        part = labels == label
        if np.median(depth[part]) > back and is_leg(part, depth, face):
            found |= part
    return found


def _face(sight: Sight, piece: Piece) -> Face:
    """The face of a piece in the pixels of a sight."""
    grid, (left, lower, right, upper) = sight.grid, piece.face.bounds
    (x, y), rows = grid.low, grid.shape[0]
    across, down = (np.array([left, right]) - x) / grid.pixel, rows - (np.array([upper, lower]) - y) / grid.pixel
    return Face(float(across[0]), float(down[0]), float(across[1]), float(down[1]))

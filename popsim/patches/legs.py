"""Legs in what a plate sees of the model; see :mod:`popsim.rendering.set_back`."""

import numpy as np

from popsim.geometry.arrays import BoolArray
from popsim.patches.piece import Piece
from popsim.patches.sight import Sight
from popsim.rendering.segmentation import label_map
from popsim.rendering.set_back import SET_BACK, STEP, Face, legs_among

LEAST = 2.0
"""mm^2; smaller parts belong to their neighbours."""


def legs(sight: Sight, piece: Piece) -> BoolArray:
    """Pixels that show parts standing back beneath nearer ones, shape (rows, columns)."""
    back = SET_BACK * piece.plate.behind
    if not (sight.mask & (sight.depth > back)).any():
        return np.zeros(sight.mask.shape, dtype=bool)
    depth = np.where(sight.mask, sight.depth, np.inf)
    labels = label_map(sight.mask, [(sight.depth, STEP)], LEAST / sight.grid.pixel**2)
    return legs_among(labels, depth, _face(sight, piece), lambda part: bool(np.median(depth[part]) > back))


def _face(sight: Sight, piece: Piece) -> Face:
    """The face of a piece in the pixels of a sight."""
    grid, (left, lower, right, upper) = sight.grid, piece.face.bounds
    (x, y), rows = grid.low, grid.shape[0]
    across, down = (np.array([left, right]) - x) / grid.pixel, rows - (np.array([upper, lower]) - y) / grid.pixel
    return Face(float(across[0]), float(down[0]), float(across[1]), float(down[1]))

"""The corners of patches that matter for extremes: those of their convex hulls.

Heights over a plane, coordinates, and distances between two rigid motions of one patch are greatest there.
"""

from itertools import pairwise

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform

FEW = 8
"""Outlines up to this need no hull."""


def hull_corners(patch: Patch) -> FloatArray:
    """Corners of the convex hull of a patch, open pose, shape (k, 3)."""
    from shapely import convex_hull, get_coordinates, multipoints

    if len(patch.points) <= FEW:
        return patch.points
    flat = patch.plane.flat(patch.points)
    ring = get_coordinates(convex_hull(multipoints(flat)))[:-1]
    order = {tuple(corner): index for index, corner in enumerate(flat.tolist())}
    return np.asarray(patch.points[[order[tuple(corner)] for corner in ring.tolist()]])


class Corners:
    """Hull corners of all patches of a design in one row, which move with their patches.

    Attributes
    ----------
    hulls:
        Corners of each patch in the open pose, (k, 3).
    spans:
        Where those of each patch are in the row.
    """

    def __init__(self, patches: tuple[Patch, ...]) -> None:
        self.hulls = tuple(hull_corners(patch) for patch in patches)
        ends = np.cumsum([0, *map(len, self.hulls)]).tolist()
        self.spans = tuple(slice(start, end) for start, end in pairwise(ends))
        self._starts = np.array(ends[:-1], dtype=np.int64)

    def moved(self, poses: FloatArray) -> FloatArray:
        """Corners in poses (n, p, 4, 4) of all patches, shape (n, v, 3); those of one number at once."""
        moved = np.empty((len(poses), sum(map(len, self.hulls)), 3))
        sizes = np.array([len(hull) for hull in self.hulls])
        for size in np.unique(sizes).tolist():
            alike = np.flatnonzero(sizes == size)
            places = self._starts[alike][:, None] + np.arange(size)
            moved[:, places] = transform(poses[:, alike], np.array([self.hulls[k] for k in alike]))
        return moved

    def least(self, values: FloatArray) -> FloatArray:
        """Least of `values` (n, v, ...) over the corners of each patch, shape (n, p, ...)."""
        return np.minimum.reduceat(values, self._starts, axis=1)

    def greatest(self, values: FloatArray) -> FloatArray:
        """Greatest of `values` (n, v, ...) over the corners of each patch, shape (n, p, ...)."""
        return np.maximum.reduceat(values, self._starts, axis=1)

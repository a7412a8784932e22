"""The corners of a patch that matter for extremes: those of its convex hull.

Heights over a plane, coordinates, and distances between two rigid motions of one patch are greatest there.
"""

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray

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

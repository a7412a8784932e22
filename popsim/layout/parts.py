"""Parts: the rigid bits of paper that sheets are made of. One per patch, more where a patch exceeds the sheet."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane

if TYPE_CHECKING:
    from shapely.geometry import Polygon


FOLD = np.array([1.0, 0.0, 0.0])
"""Direction of the central fold, along which the grain of the paper runs."""

ACROSS = 0.25
"""A patch is square to the fold where less than this share of its direction lies in its plane."""


@dataclass(frozen=True, eq=False)
class Part:
    """A patch, or a part of one, seen flat from its printed side.

    Attributes
    ----------
    id:
        The patch's id; "G/2" for the second part of a divided patch.
    patch:
        What it is (part) of.
    plane:
        Its plane in the open pose; the normal points to the printed side, so flat coordinates read as printed.
    polygon:
        Outline and holes in flat coordinates, mm.
    """

    id: str
    patch: Patch
    plane: Plane
    polygon: "Polygon"

    def flat(self, points: FloatArray) -> FloatArray:
        """Flat coordinates (..., 2) of points (..., 3) of the open pose."""
        return self.plane.flat(points)


def printed_plane(patch: Patch) -> Plane:
    """Plane of a patch with its normal to the printed side.

    That is the side from which its texture reads properly; without a texture frame the side from which the
    outline runs counterclockwise.
    """
    frame = patch.texture_frame
    if frame is None:
        return patch.plane
    normal = np.cross(frame.right, frame.up)
    if normal @ patch.plane.normal >= 0:
        return patch.plane
    return Plane.facing(-patch.plane.normal, patch.plane.origin)


def with_grain(plane: Plane, axis: int) -> Plane:
    """The same plane with the grain of the paper along its u (axis 0) or v (axis 1).

    The grain runs along the central fold, as seen squarely from the plane; in planes that are square to it, level.
    """
    normal = plane.normal
    seen = FOLD - (FOLD @ normal) * normal
    if np.linalg.norm(seen) < ACROSS:
        seen = np.cross([0.0, 0.0, 1.0], normal)
    along = seen / np.linalg.norm(seen)
    if axis == 0:
        return Plane(plane.origin, along, np.cross(normal, along))
    return Plane(plane.origin, np.cross(along, normal), along)


def whole(patch: Patch, grain: int | None = None) -> Part:
    """The whole patch as one part; `grain` is the flat axis that the grain of the paper follows, if any."""
    import shapely

    plane = printed_plane(patch) if grain is None else with_grain(printed_plane(patch), grain)
    return Part(patch.id, patch, plane, shapely.orient_polygons(plane.polygon(patch.points, patch.hole_points)))

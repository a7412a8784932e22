"""Parts: the rigid bits of paper that sheets are made of. One per patch, more where a patch exceeds the sheet."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane

if TYPE_CHECKING:
    from shapely.geometry import Polygon


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


def whole(patch: Patch) -> Part:
    """The whole patch as one part."""
    import shapely

    plane = printed_plane(patch)
    return Part(patch.id, patch, plane, shapely.orient_polygons(plane.polygon(patch.points, patch.hole_points)))

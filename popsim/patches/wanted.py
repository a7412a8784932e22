"""The part of a plate on which the model shows."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.patches.clean import common
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings
from popsim.patches.sight import Grid, look
from popsim.patches.silhouette import mask_polygon
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

SLAB = 0.35
"""Outside the face, the model shows on a plate to this share of the depth `behind`."""

SLAB_OF_FACE = 0.3
"""The same depth is at most this share of the side of a square as large as the face."""

REACH = 1e6
"""mm; beyond any model."""


def wanted(scene: RayScene, piece: Piece, settings: PatchSettings) -> "BaseGeometry":
    """Silhouette of the model on a plate, in flat coordinates; it may be empty or in parts.

    Within the face all of the model in the plate's box of space shows that lies no deeper than `behind`; in the
    rest of the room only what lies near the plane of the face. Patches inside show nothing: they are cut to what
    both sides hide.
    """
    grid = Grid.over(piece.plane, piece.room.bounds, settings.pixel)
    if not piece.plate.principal:
        front = look(scene, grid, piece.box, -REACH, 0.0)
        back_grid = Grid.over(_turned(piece.plane), _mirrored(piece.room.bounds), settings.pixel)
        back = look(scene, back_grid, piece.box, -REACH, 0.0)
        both = front.mask & back.mask[:, ::-1]
        return common(mask_polygon(both, grid), piece.face)
    sight = look(scene, grid, piece.box, -REACH, depths(piece, grid, piece.room))
    return common(mask_polygon(sight.mask, grid), piece.room)


def depths(piece: Piece, grid: Grid, region: "BaseGeometry") -> FloatArray:
    """How deep behind its plane a plate shows the model, by pixel; NaN outside `region`, shape (n,)."""
    import shapely

    u, v = grid.centres().T
    behind = min(piece.plate.behind, REACH)
    slab = min(SLAB * behind, SLAB_OF_FACE * float(np.sqrt(piece.face.area)))
    face, within = piece.face.buffer(grid.pixel / 2), region.buffer(grid.pixel / 2)
    for polygon in (face, within):
        shapely.prepare(polygon)
    far = np.where(shapely.contains_xy(face, u, v), behind, slab)
    far[~shapely.contains_xy(within, u, v)] = np.nan
    return np.asarray(far)


def _turned(plane: Plane) -> Plane:
    """The same plane seen from behind."""
    return Plane(plane.origin, -plane.u, plane.v)


def _mirrored(bounds: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    left, lower, right, upper = bounds
    return -right, lower, -left, upper

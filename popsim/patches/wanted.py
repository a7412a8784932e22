"""The part of a plate on which the model shows."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.plane import Plane
from popsim.patches.clean import common, polygons, union, without
from popsim.patches.legs import legs
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings
from popsim.patches.sight import Grid, look, shows
from popsim.patches.silhouette import mask_polygon
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

LEAST_FIN = 25.0
"""mm^2; smaller fins are not worth a slit."""

LEAST_RISE = 4.0
"""mm; where a fin rises by less, the hinge stays whole."""

REACH = 1e6
"""mm; beyond any model."""


def see(scene: RayScene, piece: Piece, settings: PatchSettings) -> None:
    """Give a piece the silhouette of the model on it; it may be empty or in parts.

    Within the face all of the model in the plate's box of space shows that lies no deeper than `behind`, and
    what lies deeper where the rest encloses it, but no legs; in the rest of the room only what lies near the
    plane of the face. Patches inside are cut to what both sides hide, or one of them; beyond their faces they rise
    as fins where both sides see the model near their plane.
    """
    grid = Grid.over(piece.plane, piece.room.bounds, settings.pixel)
    if not piece.plate.principal:
        hidden = common(mask_polygon(_hidden(scene, piece, grid), grid), piece.face)
        piece.shape = union(hidden, *_fins(scene, piece, grid))
        return
    mask = _shown(scene, piece, grid)
    dents = _enclosed(mask, piece, grid)
    if dents.any():
        dents = shows(scene, grid, piece.box, -REACH, np.where(dents, REACH, np.nan))
        piece.recesses = mask_polygon(dents, grid).buffer(grid.pixel)
    piece.shape = common(mask_polygon(mask | dents, grid), piece.room)


def _shown(scene: RayScene, piece: Piece, grid: Grid) -> BoolArray:
    """Pixels on which the model shows, but for legs."""
    far = depths(piece, grid, piece.room)
    if piece.stands or piece.plate.lies:
        return shows(scene, grid, piece.box, -REACH, far)
    sight = look(scene, grid, piece.box, -REACH, far, bary=False)
    return sight.mask & ~legs(sight, piece)


def _between(scene: RayScene, piece: Piece, grid: Grid, within: BoolArray, depth: float) -> BoolArray:
    """Pixels at which the model reaches from one side of a plane to the other, or at most `depth` short of it."""
    mask = shows(scene, grid, piece.box, -REACH, np.where(within, depth, np.nan))
    left, lower = grid.low
    right = left + grid.shape[1] * grid.pixel
    behind = Grid(_turned(piece.plane), np.array([-right, lower]), grid.pixel, grid.shape)
    return shows(scene, behind, piece.box, -REACH, np.where(mask[:, ::-1], depth, np.nan))[:, ::-1]


def _hidden(scene: RayScene, piece: Piece, grid: Grid) -> BoolArray:
    """Pixels that both sides hide, and what lies amid them, but for windows through to the far side."""
    from scipy.ndimage import binary_fill_holes

    hidden = _between(scene, piece, grid, np.ones(grid.shape, dtype=bool), 0.0)
    amid = np.asarray(binary_fill_holes(hidden)) & ~hidden
    if amid.any():
        hidden |= shows(scene, grid, piece.box, -REACH, np.where(amid, REACH, np.nan))
    return hidden


def _fins(scene: RayScene, piece: Piece, grid: Grid) -> list["Polygon"]:
    """What rises beyond the face of a patch inside: worth cutting, and standing on the face."""
    beyond = without(piece.room, piece.face)
    if beyond.is_empty:
        return []
    free = grid.covered(beyond)
    mask = _between(scene, piece, grid, free, piece.plate.beside)
    beneath = free & np.maximum.accumulate(mask, axis=0)  # all from the highest place of the fin down to the face
    mask &= beneath.sum(axis=0) * grid.pixel >= LEAST_RISE
    fins = polygons(common(mask_polygon(mask, grid), beyond))
    return [fin for fin in fins if fin.area >= LEAST_FIN and fin.distance(piece.face) <= grid.pixel]


def _enclosed(mask: BoolArray, piece: Piece, grid: Grid) -> BoolArray:
    """Pixels of the face outside the mask, but enclosed by it, by seams and by the foot of an upright plate."""
    from scipy.ndimage import binary_fill_holes

    left, lower, right, _ = piece.face.bounds
    lines = list(piece.seams)
    if not piece.plate.lies:
        lines.append(np.array([[left, lower - grid.pixel], [right, lower - grid.pixel]]))
    walls = np.pad(mask, 1)
    for line in lines:
        row, column = grid.pixels(line).T
        walls[np.clip(row + 1, 0, walls.shape[0] - 1), np.clip(column + 1, 0, walls.shape[1] - 1)] = True
    return np.asarray(binary_fill_holes(walls)[1:-1, 1:-1] & ~mask & grid.covered(piece.face))


def depths(piece: Piece, grid: Grid, region: "BaseGeometry") -> FloatArray:
    """How deep behind its plane a plate shows the model, by pixel; NaN outside `region`, shape (rows, columns)."""
    behind = min(piece.plate.behind, REACH) if piece.plate.principal else np.nan
    far = np.where(grid.covered(piece.face.buffer(grid.pixel / 2)), behind, piece.plate.beside)
    if not piece.recesses.is_empty:
        far[grid.covered(piece.recesses)] = REACH
    far[~grid.covered(region.buffer(grid.pixel / 2))] = np.nan
    return np.asarray(far)


def _turned(plane: Plane) -> Plane:
    """The same plane seen from behind."""
    return Plane(plane.origin, -plane.u, plane.v)

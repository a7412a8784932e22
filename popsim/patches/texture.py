"""The print of a patch: what it sees of the model, with colours continued to where it sees nothing."""

from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np

from popsim.design.model import TextureFrame
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray, UInt8Array
from popsim.mechanisms.assemble import as_points
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings
from popsim.patches.sight import Grid, colours, look
from popsim.patches.wanted import REACH, depths
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

COARSE = 4
"""Pixels per cell in which the nearest colour is looked for; finer cannot be seen beyond a cut."""

COMPRESSION = 4
"""Of zlib: twice as fast as the best for a few percent of size."""


def print_of(
    scene: RayScene, piece: Piece, outline: "Polygon", settings: PatchSettings
) -> tuple[bytes, TextureFrame] | None:
    """PNG image of a patch and where it lies, or None where the model does not show on it at all.

    The image covers the outline and the bleed around it. Pixels in which the plate sees nothing take the colour
    of the nearest one that does.
    """
    left, lower, right, upper = outline.bounds
    bleed = settings.bleed
    bounds = (left - bleed, lower - bleed, right + bleed, upper + bleed)
    grid = Grid.over(piece.plane, bounds, settings.print_pixel)
    sight = look(scene, grid, piece.box, -REACH, _depths(piece, grid, outline.buffer(bleed)))
    if not sight.mask.any():
        return None
    image = colours(scene, sight)
    filled = np.take(image.reshape(-1, 3), nearest_seen(sight.mask).ravel(), axis=0).reshape(image.shape)
    return png(filled), frame_of(grid)


def frame_of(grid: Grid) -> TextureFrame:
    """Where the image of a grid lies in the open pose."""
    rows, columns = grid.shape
    origin = grid.plane.lift(grid.low)
    right, up = columns * grid.pixel * grid.plane.u, rows * grid.pixel * grid.plane.v
    points = as_points(np.array([origin, right, up]))
    return TextureFrame(origin=points[0], right=points[1], up=points[2])


def nearest_seen(mask: BoolArray) -> IntArray:
    """Index of the pixel that each pixel takes its colour from, shape (rows, columns): itself where it sees."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = mask.shape
    source = np.arange(rows * columns).reshape(rows, columns)
    if mask.all():
        return source
    tall, wide = -(-rows // COARSE), -(-columns // COARSE)
    padded = np.full((tall * COARSE, wide * COARSE), -1, dtype=np.int64)
    padded[:rows, :columns] = np.where(mask, source, -1)
    cells = padded.reshape(tall, COARSE, wide, COARSE).max(axis=(1, 3))
    row, column = distance_transform_edt(cells < 0, return_distances=False, return_indices=True)
    spread = np.repeat(np.repeat(cells[row, column], COARSE, axis=0), COARSE, axis=1)[:rows, :columns]
    return np.where(mask, source, spread)


def png(image: UInt8Array) -> bytes:
    """The same bytes for the same pixels: no time, no text."""
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(image).save(stream, format="PNG", compress_level=COMPRESSION)
    return stream.getvalue()


def _depths(piece: Piece, grid: Grid, region: "BaseGeometry") -> FloatArray:
    """How deep each pixel looks, found for whole cells; NaN outside `region`, shape (n,)."""
    rows, columns = grid.shape
    right, upper = grid.low + np.array([columns, rows]) * grid.pixel
    coarse = Grid.over(grid.plane, (*grid.low, right, upper), grid.pixel * COARSE)
    far = depths(piece, coarse, region).reshape(coarse.shape)
    fine = np.repeat(np.repeat(far, COARSE, axis=0), COARSE, axis=1)
    return np.ascontiguousarray(fine[-rows:, :columns]).ravel()

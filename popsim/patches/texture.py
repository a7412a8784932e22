"""The print of a patch: what it sees of the model, with colours continued to where it sees nothing."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.design.model import TextureFrame
from popsim.geometry.arrays import BoolArray, IntArray, UInt8Array
from popsim.mechanisms.assemble import as_points
from popsim.patches.piece import Piece
from popsim.patches.refine import BLOCK, refined
from popsim.patches.settings import PatchSettings
from popsim.patches.sight import Grid, colours, lines, look
from popsim.patches.wanted import REACH, depths
from popsim.rendering.light import LINE
from popsim.rendering.opencv import opencv
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry import Polygon

FAST = 1
"""Level of zlib; with one filter for all rows, and runs instead of searches, files are small in half the time."""


class Print(NamedTuple):
    """A PNG image and where it lies in the open pose."""

    png: bytes
    frame: TextureFrame


def print_of(scene: RayScene, piece: Piece, outline: "Polygon", settings: PatchSettings) -> Print | None:
    """The print of a patch, or None where the model does not show on it at all.

    The image covers the outline and the bleed around it. Pixels in which the plate sees nothing take the colour
    of the nearest block that does. Where colours change slowly, pixels are interpolated between blocks.
    """
    left, lower, right, upper = outline.bounds
    bleed, block = settings.bleed, settings.print_pixel * BLOCK
    blocks = Grid.over(piece.plane, (left - bleed, lower - bleed, right + bleed, upper + bleed), block)
    far = depths(piece, blocks, outline.buffer(bleed))
    sight = look(scene, blocks, piece.box, -REACH, far)
    if not sight.mask.any():
        return None
    filled = colours(scene, sight)[nearest_seen(sight.mask)]
    if scene.paint.plain:
        at = lines(scene, sight)
        filled[at] = (filled[at] * LINE).astype(np.uint8)
    grid, image = refined(scene, sight, filled, piece.box, -REACH, far)
    return Print(png(image), frame_of(grid))


def frame_of(grid: Grid) -> TextureFrame:
    """Where the image of a grid lies in the open pose."""
    rows, columns = grid.shape
    origin = grid.plane.lift(grid.low)
    right, up = columns * grid.pixel * grid.plane.u, rows * grid.pixel * grid.plane.v
    points = as_points(np.array([origin, right, up]))
    return TextureFrame(origin=points[0], right=points[1], up=points[2])


def nearest_seen(mask: BoolArray) -> tuple[IntArray, IntArray]:
    """Row and column of the nearest true pixel of a mask, nearly, for each of its pixels."""
    cv2 = opencv()
    unseen = np.where(mask, np.uint8(0), np.uint8(255))
    _, labels = cv2.distanceTransformWithLabels(unseen, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    place = np.zeros(int(labels.max()) + 1, dtype=np.int64)
    seen = np.flatnonzero(mask)
    place[labels.ravel()[seen]] = seen
    row, column = np.divmod(place[labels], mask.shape[1])
    return row, column


def png(image: UInt8Array) -> bytes:
    """An image (rows, columns, 3) as a PNG: the same bytes for the same pixels, no time, no text."""
    cv2 = opencv()
    how = (
        (cv2.IMWRITE_PNG_COMPRESSION, FAST),
        (cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE),
        (cv2.IMWRITE_PNG_FILTER, cv2.IMWRITE_PNG_FILTER_PAETH),
    )
    _, data = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), [word for pair in how for word in pair])
    return bytes(data.tobytes())

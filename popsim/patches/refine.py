"""From blocks of printed pixels to pixels: looked at again only where the picture changes.

Most of a print is flat, and its pixels are interpolated between blocks. Where colours change within one face, each
pixel is coloured by its own place on that face, which is linear in the picture; only where faces end is the
model looked at again.
"""

from typing import TypeVar

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray, UInt8Array
from popsim.patches.sight import Grid, Sight, colours, look
from popsim.rendering.opencv import opencv
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.texture import eight_bit

Values = TypeVar("Values", FloatArray, IntArray, BoolArray)

BLOCK = 2
"""Pixels per side of a block."""

CONTRAST = 10
"""Of 255: blocks that differ by more from a neighbour are refined."""


def refined(
    scene: RayScene, sight: Sight, filled: UInt8Array, box: FloatArray, near: float, far: FloatArray
) -> tuple[Grid, UInt8Array]:
    """The pixels of a picture of blocks.

    Parameters
    ----------
    scene, box, near, far:
        As the blocks were looked at, see :func:`popsim.patches.sight.look`; `far` of shape (rows, columns).
    sight:
        What the blocks see.
    filled:
        Their colours, shape (rows, columns, 3).

    Returns
    -------
    Grid of the pixels and their colours, shape (2 rows, 2 columns, 3).
    """
    blocks = sight.grid
    image = _enlarged(filled)
    grid = Grid(blocks.plane, blocks.low, blocks.pixel / BLOCK, (image.shape[0], image.shape[1]))
    if scene.paint.plain:
        return grid, image
    changing, one_face = _changing(filled, sight.mask), _within_faces(sight)
    _colour_faces(scene, sight, changing & one_face, image)
    closer = look(scene, grid, box, near, _pixels(np.where(changing & ~one_face, far, np.nan)))
    image[closer.mask] = colours(scene, closer)[closer.mask]
    return grid, image


def _enlarged(image: UInt8Array) -> UInt8Array:
    """Pixels interpolated between the centres of blocks."""
    cv2 = opencv()
    rows, columns = image.shape[:2]
    return np.asarray(cv2.resize(image, (columns * BLOCK, rows * BLOCK), interpolation=cv2.INTER_LINEAR), np.uint8)


def _pixels(blocks: Values) -> Values:
    """The value of its block for each pixel."""
    return np.repeat(np.repeat(blocks, BLOCK, axis=0), BLOCK, axis=1)


def _changing(image: UInt8Array, mask: BoolArray) -> BoolArray:
    """Blocks beside which the colour or what is seen changes, shape (rows, columns)."""
    cv2 = opencv()
    channels = np.dstack([image, np.where(mask, np.uint8(255), np.uint8(0))])
    around = np.ones((3, 3), dtype=np.uint8)
    spread = cv2.dilate(channels, around) - cv2.erode(channels, around)
    return np.asarray(spread.max(axis=2) > CONTRAST)


def _within_faces(sight: Sight) -> BoolArray:
    """Blocks that see the same face as all their neighbours, shape (rows, columns); none at the rim."""
    face = sight.face.reshape(sight.grid.shape)
    same = np.zeros(face.shape, dtype=bool)
    across = (face[:, :-2] == face[:, 1:-1]) & (face[:, 2:] == face[:, 1:-1]) & (face[:, 1:-1] >= 0)
    middle = face[1:-1, 1:-1]
    down = (face[:-2, 1:-1] == middle) & (face[2:, 1:-1] == middle)
    same[1:-1, 1:-1] = across[:-2] & across[1:-1] & across[2:] & down
    return same


def _colour_faces(scene: RayScene, sight: Sight, chosen: BoolArray, image: UInt8Array) -> None:
    """Colour the pixels of blocks that lie within one face: what colours depend on goes on linearly."""
    cv2 = opencv()
    seen = np.flatnonzero(sight.face >= 0)
    known = scene.paint.places(sight.face[seen], sight.bary[seen])
    at = np.flatnonzero(_pixels(chosen))
    places = np.empty((len(at), known.shape[1]), dtype=np.float32)
    size = (image.shape[1], image.shape[0])
    for channel in range(known.shape[1]):
        blocks = np.zeros(chosen.size, dtype=np.float32)
        blocks[seen] = known[:, channel]
        enlarged = cv2.resize(blocks.reshape(chosen.shape), size, interpolation=cv2.INTER_LINEAR)
        places[:, channel] = enlarged.ravel()[at]
    faces = _pixels(sight.face.reshape(chosen.shape)).ravel()[at]
    pixels = image.reshape(-1, 3)

    def colour(part: slice) -> None:
        found = scene.paint.at(faces[part], places[part], sight.grid.pixel / BLOCK)
        pixels[at[part]] = eight_bit(found[:, :3])

    map_chunks(colour, len(at))

"""From blocks of printed pixels to pixels: looked at again only where the picture changes.

Most of a print is flat, and its pixels are interpolated between blocks. Where colours change within one face, each
pixel is coloured by its own place on that face, which is linear in the picture; only where faces end is the
model looked at again.
"""

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, UInt8Array
from popsim.patches.sight import Grid, Sight, colours, look
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.texture import eight_bit

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
    from PIL import Image

    rows, columns = image.shape[:2]
    size = (columns * BLOCK, rows * BLOCK)
    return np.array(Image.fromarray(image).resize(size, Image.Resampling.BILINEAR))


def _pixels(blocks: FloatArray) -> FloatArray:
    """The value of its block for each pixel."""
    return np.repeat(np.repeat(blocks, BLOCK, axis=0), BLOCK, axis=1)


def _changing(image: UInt8Array, mask: BoolArray) -> BoolArray:
    """Blocks beside which the colour or what is seen changes, shape (rows, columns)."""
    channels = np.dstack([image, np.where(mask, np.uint8(255), np.uint8(0))])
    highest, lowest = (_of_neighbours(pick, channels) for pick in (np.maximum, np.minimum))
    return np.asarray((highest - lowest).max(axis=2) > CONTRAST)


def _of_neighbours(pick: np.ufunc, image: UInt8Array) -> UInt8Array:
    """The greatest or least value among a pixel and its eight neighbours, channel by channel."""
    for axis in (0, 1):
        padded = np.pad(image, [(1, 1) if k == axis else (0, 0) for k in range(3)], mode="edge")
        before, here, after = (np.moveaxis(padded, axis, 0)[k : k + image.shape[axis]] for k in range(3))
        image = np.moveaxis(pick(pick(before, here), after), 0, axis)
    return image


def _within_faces(sight: Sight) -> BoolArray:
    """Blocks that see the same face as all their neighbours, shape (rows, columns); none at the rim."""
    face = sight.face.reshape(sight.grid.shape)
    same = np.zeros(face.shape, dtype=bool)
    middle = face[1:-1, 1:-1]
    same[1:-1, 1:-1] = middle >= 0
    rows, columns = face.shape
    for row in range(3):
        for column in range(3):
            same[1:-1, 1:-1] &= face[row : rows - 2 + row, column : columns - 2 + column] == middle
    return same


def _colour_faces(scene: RayScene, sight: Sight, chosen: BoolArray, image: UInt8Array) -> None:
    """Colour the pixels of blocks that lie within one face; barycentric coordinates go on linearly."""
    row, column = np.nonzero(chosen)
    columns = chosen.shape[1]

    def colour(part: slice) -> None:
        at = row[part] * columns + column[part]
        face, middle = sight.face[at], sight.bary[at]
        down = (sight.bary[at + columns] - sight.bary[at - columns]) / 2
        right = (sight.bary[at + 1] - sight.bary[at - 1]) / 2
        for i in range(BLOCK):
            for j in range(BLOCK):
                offset = [(k + 0.5) / BLOCK - 0.5 for k in (i, j)]
                place = np.clip(middle + offset[0] * down + offset[1] * right, 0, 1)
                found = scene.paint.colours(face, place, sight.grid.pixel / BLOCK)[:, :3]
                image[row[part] * BLOCK + i, column[part] * BLOCK + j] = eight_bit(found)

    map_chunks(colour, len(row))

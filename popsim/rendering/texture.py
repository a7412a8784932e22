"""Texture lookup: bilinear between texels, box-averaged levels where many texels fall on one pixel."""

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import BoolArray, FloatArray, UInt8Array

OPAQUE = 0.5  # texels of less alpha are holes

Colours = npt.NDArray[np.float32]


def eight_bit(colours: Colours) -> UInt8Array:
    """Return colours in 0..1, of any shape, as 0..255."""
    whole: UInt8Array = np.rint(np.clip(colours, 0, 1) * np.float32(255)).astype(np.uint8)
    return whole


class Texture:
    """An RGBA image with levels of half, a quarter, ... of its size, made when first needed.

    Between texels, colours are weighed by their alpha too, so that the colour of a hole never shows.
    """

    def __init__(self, image: UInt8Array) -> None:
        if image.ndim != 3 or image.shape[2] != 4 or image.dtype != np.uint8 or not image.size:
            raise GeometryError(
                f"a texture must be RGBA, shape (h, w, 4), 8 bits; found {image.shape} {image.dtype}"
            )
        self._image = image
        self._levels: dict[int, UInt8Array] = {0: np.ascontiguousarray(image)}
        self._opaque = bool((image[..., 3] == 255).all())
        self.has_holes = bool((image[..., 3] < OPAQUE * 255).any())

    @property
    def texels(self) -> int:
        """Number of texels of the whole image."""
        return int(self._image.shape[0] * self._image.shape[1])

    def holed_within(self, low: FloatArray, high: FloatArray) -> BoolArray:
        """Return whether there are holes in the rectangles of texture coordinates `low` to `high`, (k, 2).

        They lie within 0..1, give or take rounding; neighbouring texels, which may be mixed in, count too.
        """
        rows, columns = self._image.shape[:2]
        holes = np.zeros((rows + 1, columns + 1), dtype=np.int64)
        holes[1:, 1:] = (self._image[..., 3] < OPAQUE * 255).cumsum(axis=0).cumsum(axis=1)
        left, right = low[:, 0] * columns, high[:, 0] * columns
        top, bottom = (1 - high[:, 1]) * rows, (1 - low[:, 1]) * rows
        first = [np.clip(np.floor(at).astype(np.int64) - 1, 0, n) for at, n in ((top, rows), (left, columns))]
        last = [np.clip(np.ceil(at).astype(np.int64) + 1, 0, n) for at, n in ((bottom, rows), (right, columns))]
        count = holes[last[0], last[1]] - holes[first[0], last[1]]
        within: BoolArray = count - holes[last[0], first[1]] + holes[first[0], first[1]] > 0
        return within

    def _level(self, level: int) -> UInt8Array:
        if level not in self._levels:
            from PIL import Image

            rows, columns = (max(1, n >> level) for n in self._image.shape[:2])
            small = Image.fromarray(self._image).resize((columns, rows), Image.Resampling.BOX)
            self._levels[level] = np.ascontiguousarray(small)
        return self._levels[level]

    def sample(self, uv: FloatArray, one_tile: BoolArray, texels_per_pixel: FloatArray) -> Colours:
        """Return the colours (k, 4) in 0..1 at the texture coordinates `uv` (k, 2).

        Parameters
        ----------
        uv:
            v = 1 is the upper edge of the image; the image repeats.
        one_tile:
            Where true, shape (k,), the face lies within the repetition 0..1 alone: its border texels are
            not mixed with those of the opposite border.
        texels_per_pixel:
            How many texels a pixel spans in one direction, shape (k,).
        """
        top = int(np.log2(max(self._image.shape[:2])))
        level = np.clip(np.rint(np.log2(np.maximum(texels_per_pixel, 1.0))), 0, top).astype(np.int64)
        used = np.flatnonzero(np.bincount(level))
        if len(used) == 1:
            return _bilinear(self._level(int(used[0])), uv, one_tile, self._opaque)
        colours = np.empty((len(uv), 4), dtype=np.float32)
        for each in used:
            at = np.flatnonzero(level == each)
            colours[at] = _bilinear(self._level(int(each)), uv[at], one_tile[at], self._opaque)
        return colours


def _bilinear(image: UInt8Array, uv: FloatArray, one_tile: BoolArray, opaque: bool) -> Colours:
    """Channel after channel: numpy is several times as fast on long rows as on rows of four."""
    rows, columns = image.shape[:2]
    column, column_weight = _neighbours(uv[:, 0], columns, one_tile)
    row, row_weight = _neighbours(1.0 - uv[:, 1], rows, one_tile)
    texels = image.view("<u4").ravel()
    total = np.zeros((4, len(uv)), dtype=np.float32)
    for j in (0, 1):
        for i in (0, 1):
            found = texels.take(row[j] * columns + column[i])
            weight = row_weight[j] * column_weight[i]
            if not opaque:
                weight *= found >> 24
            total[3] += weight
            for channel in range(3):
                total[channel] += weight * ((found >> 8 * channel) & 255).astype(np.float32)
    total[:3] /= np.maximum(total[3], np.float32(1e-6)) * np.float32(255)
    if not opaque:
        total[3] /= np.float32(255)
    return total.T


def _neighbours(
    at: FloatArray, count: int, one_tile: BoolArray
) -> tuple[list[npt.NDArray[np.int32]], list[Colours]]:
    """Return the two texels on either side of `at` (in images), and their weights."""
    inside = at * count - 0.5
    low = np.floor(inside)
    fraction = (inside - low).astype(np.float32)
    first = low.astype(np.int32)
    indices = []
    for index in (first, first + 1):
        within = np.clip(index, 0, count - 1)
        if not one_tile.all():
            np.copyto(within, index % count, where=~one_tile)
        indices.append(within)
    return indices, [1 - fraction, fraction]

"""Texture lookup: bilinear between texels, box-averaged levels where many texels fall on one pixel."""

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import BoolArray, FloatArray, UInt8Array
from popsim.rendering.opencv import opencv

OPAQUE = 0.5  # texels of less alpha are holes
ROW = 512  # places are looked up in rows of so many
LONGEST = 16_384  # texels along a side that OpenCV's remap reaches, which counts in 16 bits, with a margin

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

    def sample(
        self, uv: npt.NDArray[np.float32], one_tile: BoolArray, texels_per_pixel: npt.NDArray[np.float32]
    ) -> Colours:
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
        level = np.clip(np.rint(np.log2(np.maximum(texels_per_pixel, 1.0))), 0, top).astype(np.int8)
        kind = 2 * level + one_tile
        used = np.flatnonzero(np.bincount(kind))
        if len(used) == 1:
            return self._sampled(int(used[0]) // 2, uv, bool(used[0] % 2))
        colours = np.empty((len(uv), 4), dtype=np.float32)
        for each in used:
            at = np.flatnonzero(kind == each)
            colours[at] = self._sampled(int(each) // 2, uv[at], bool(each % 2))
        return colours

    def _sampled(self, level: int, uv: npt.NDArray[np.float32], one_tile: bool) -> Colours:
        """Colours between the texels of a level."""
        image = self._level(level)
        if max(image.shape) > LONGEST or not self._opaque:
            return _bilinear(image, uv, one_tile, self._opaque)
        return _opaque_bilinear(image, uv, one_tile)


def _opaque_bilinear(image: UInt8Array, uv: npt.NDArray[np.float32], one_tile: bool) -> Colours:
    """As :func:`_bilinear`, to the nearest of 255 steps, in a fifth of the time."""
    cv2 = opencv()
    count, (rows, columns) = len(uv), image.shape[:2]
    at = np.zeros((2, -(-count // ROW) * ROW), dtype=np.float32)
    within = uv if one_tile else uv - np.floor(uv)
    at[0, :count] = within[:, 0] * columns - 0.5
    at[1, :count] = (1 - within[:, 1]) * rows - 0.5
    across, down = at.reshape(2, -1, ROW)
    border = cv2.BORDER_REPLICATE if one_tile else cv2.BORDER_WRAP
    found = cv2.remap(image, across, down, cv2.INTER_LINEAR, borderMode=border)
    colours: Colours = found.reshape(-1, 4)[:count] * np.float32(1 / 255)
    return colours


def _bilinear(image: UInt8Array, uv: npt.NDArray[np.float32], one_tile: bool, opaque: bool) -> Colours:
    """Channel after channel: numpy is several times as fast on long rows as on rows of four."""
    rows, columns = image.shape[:2]
    column, column_weight = _neighbours(uv[:, 0], columns, one_tile)
    row, row_weight = _neighbours(1 - uv[:, 1], rows, one_tile)
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
    at: npt.NDArray[np.float32], count: int, one_tile: bool
) -> tuple[list[npt.NDArray[np.int32]], list[Colours]]:
    """Return the two texels on either side of `at` (in images), and their weights."""
    inside = at * count - np.float32(0.5)
    low = np.floor(inside)
    fraction = inside - low
    first = low.astype(np.int32)
    indices = [np.clip(index, 0, count - 1) if one_tile else index % count for index in (first, first + 1)]
    return indices, [1 - fraction, fraction]

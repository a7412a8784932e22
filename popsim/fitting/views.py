"""Pixels of nine parallel views of the open card, and where they meet a plane."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.fitting.slant import ACROSS
from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray

PIXELS = 64
"""Pixels along the diagonal of the model, in each view."""

LIFT = np.sin(np.radians(30.0))
"""Height of the views over the corners."""

EDGE_ON = 0.01
"""A plane whose normal makes a smaller cosine with a view is not seen in it."""


def view_directions() -> FloatArray:
    """Directions to the eye: front, back, sides, top, and four over the corners, shape (9, 3)."""
    level = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    flat = np.cos(np.radians(30.0)) / np.sqrt(2)
    corners = [(i * flat, j * flat, LIFT) for i in (1, -1) for j in (1, -1)]
    return np.array(level + corners, float)


@dataclass(frozen=True, eq=False)
class Views:
    """Square pictures of what lies in a box, as wide as its diagonal.

    Attributes
    ----------
    centre:
        Centre of the box, shape (3,).
    diagonal:
        Its diagonal, mm; eyes are that far from the centre.
    pixels:
        Pixels along the diagonal.
    """

    centre: FloatArray
    diagonal: float
    pixels: int = PIXELS

    @staticmethod
    def of(bounds: FloatArray, pixels: int = PIXELS) -> "Views":
        """The views of a box, rows low and high, shape (2, 3)."""
        return Views(bounds.mean(axis=0), float(np.linalg.norm(bounds[1] - bounds[0])), pixels)

    @cached_property
    def axes(self) -> FloatArray:
        """Directions to the right, up and to the eye of each view, shape (9, 3, 3)."""
        eyes = view_directions()
        level = np.abs(eyes[:, 2:]) < 0.9
        upright = np.where(level, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
        right = np.cross(upright, eyes)
        right /= np.linalg.norm(right, axis=1, keepdims=True)
        return np.stack([right, np.cross(eyes, right), eyes], axis=1)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of views, and of pixels in each."""
        return len(self.axes), self.pixels * self.pixels

    def rays(self) -> tuple[FloatArray, FloatArray]:
        """Origins and directions of the rays of all pixels, view after view, shape (9 p, 3)."""
        across, up = (steps.reshape(*self.shape, 1) for steps in self._steps)
        right, rise, eye = self.axes[:, None, 0], self.axes[:, None, 1], self.axes[:, None, 2]
        origins = self.centre + across * right + up * rise + self.diagonal * eye
        directions = np.broadcast_to(-eye, origins.shape)
        return origins.reshape(-1, 3), directions.reshape(-1, 3)

    def drawn(self, stencil: Stencil) -> tuple[IntArray, FloatArray]:
        """Draw a stencil into all views that see its plane.

        Returns
        -------
        tuple
            Index of each pixel in which it shows, in the order of :meth:`rays`, shape (k,), and how far what shows
            there is from the origin of its ray, mm, shape (k,).
        """
        slant = stencil.slant
        equation = slant.equation
        right, rise, eye = (self.axes @ equation).T
        corners = (slant.corners(*stencil.box) - self.centre) @ self.axes[:, :2].transpose(0, 2, 1)
        ends = corners.min(axis=1), corners.max(axis=1)
        low, high = (np.round((end / self.diagonal + 0.5) * self.pixels).astype(np.int64) for end in ends)
        low, high = low.clip(0, self.pixels), high.clip(0, self.pixels)
        views = np.flatnonzero((np.abs(eye) > EDGE_ON * np.linalg.norm(equation)) & (high > low).all(axis=1))
        offset = np.full(len(views), slant.level - self.centre @ equation)
        ahead = np.column_stack([-right[views], -rise[views], offset]) / eye[views, None]
        places = ahead[:, None] * self.axes[views, 2, :, None]
        places[:, :, 2] += self.centre
        places[:, :, :2] += self.axes[views, :2].transpose(0, 2, 1)
        cells = (places[:, ACROSS[slant.axis]] - stencil.low[:, None] * [0, 0, 1]) / stencil.grain[:, None]
        found = self._pasted(stencil.mask, views, low[views], high[views], cells @ self._of_pixel)
        count = np.searchsorted(found, self.pixels**2 * np.append(views, len(self.axes)))
        away = np.repeat([0, 0, self.diagonal] - ahead, np.diff(count), axis=0)
        across, up = (steps[found] for steps in self._steps)
        return found, away[:, 0] * across + away[:, 1] * up + away[:, 2]

    def _pasted(
        self, mask: BoolArray, views: IntArray, low: IntArray, high: IntArray, cells: FloatArray
    ) -> IntArray:
        """Indices of the pixels in which a mask shows.

        Parameters
        ----------
        mask:
            Shape (n, m).
        views:
            Those into which it is drawn, shape (v,).
        low, high:
            First pixel, and that behind the last one, shape (v, 2).
        cells:
            Which cell each pixel shows: affine functions of column, row and 1, shape (v, 2, 3).
        """
        from cv2 import INTER_NEAREST, WARP_INVERSE_MAP, warpAffine

        picture = mask.view(np.uint8)
        canvas = np.zeros((len(self.axes), self.pixels, self.pixels), dtype=np.uint8)
        starts = np.column_stack([low + 0.5, np.ones(len(low))])
        cells = cells[:, ::-1].copy()  # columns first
        cells[:, :, 2] = (cells * starts[:, None]).sum(axis=2) - 0.5  # of whole numbers, to whole numbers
        for view, (x0, y0), (x1, y1), affine in zip(views, low, high, cells, strict=True):
            seen = canvas[view, y0:y1, x0:x1]
            warpAffine(picture, affine, seen.shape[::-1], dst=seen, flags=INTER_NEAREST | WARP_INVERSE_MAP)
        return np.flatnonzero(canvas)

    @cached_property
    def _of_pixel(self) -> FloatArray:
        """How far a pixel lies right of the centre, over it, and 1, as functions of column, row and 1."""
        side, half = self.diagonal / self.pixels, self.diagonal / 2
        return np.array([[side, 0, -half], [0, side, -half], [0, 0, 1]])

    @cached_property
    def _steps(self) -> tuple[FloatArray, FloatArray]:
        """How far the pixels of all views lie right of the centre, and over it, mm, each of shape (9 p,)."""
        steps = self.diagonal * ((np.arange(self.pixels) + 0.5) / self.pixels - 0.5)
        return np.tile(steps, len(self.axes) * self.pixels), np.tile(np.repeat(steps, self.pixels), len(self.axes))

"""Pixels of nine parallel views of the open card, and where they meet a plane."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray

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
        steps = self.diagonal * ((np.arange(self.pixels) + 0.5) / self.pixels - 0.5)
        up, across = (grid.reshape(-1, 1) for grid in np.meshgrid(steps, steps, indexing="ij"))
        right, rise, eye = self.axes[:, None, 0], self.axes[:, None, 1], self.axes[:, None, 2]
        origins = self.centre + across * right + up * rise + self.diagonal * eye
        directions = np.broadcast_to(-eye, origins.shape)
        return origins.reshape(-1, 3), directions.reshape(-1, 3)

    def cast(self, corners: FloatArray, normal: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Find the pixels of all views around the corners (n, 3) of a polygon, and where they meet its plane.

        Returns
        -------
        tuple
            Index of each pixel in the order of :meth:`rays`, shape (k,); the point of the plane that it sees,
            shape (k, 3); and how far that is from the origin of its ray, mm, shape (k,).
        """
        facing = self.axes[:, 2] @ normal
        views = np.flatnonzero(np.abs(facing) > EDGE_ON)
        flat = (corners - self.centre) @ self.axes[views, :2].transpose(0, 2, 1) / self.diagonal + 0.5
        low = np.clip(np.ceil(flat.min(axis=1) * self.pixels - 0.5).astype(np.int64), 0, self.pixels)
        high = np.clip(np.floor(flat.max(axis=1) * self.pixels - 0.5).astype(np.int64) + 1, low, self.pixels)
        wide, tall = (high - low).T
        count = wide * tall
        which = np.repeat(np.arange(len(views)), count)
        number = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        column, row = low[which, 0] + number % wide[which], low[which, 1] + number // wide[which]
        right, rise, eye = (self.axes[views[which], k] for k in range(3))
        across = self.diagonal * ((column + 0.5) / self.pixels - 0.5)
        up = self.diagonal * ((row + 0.5) / self.pixels - 0.5)
        ahead = (corners[0] - self.centre) @ normal - across * (right @ normal) - up * (rise @ normal)
        ahead /= facing[views[which]]
        points = self.centre + across[:, None] * right + up[:, None] * rise + ahead[:, None] * eye
        return views[which] * self.pixels * self.pixels + row * self.pixels + column, points, self.diagonal - ahead

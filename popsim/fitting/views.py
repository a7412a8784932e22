"""Pixels of nine parallel views of the open card, and where they meet a plane."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from popsim.fitting.slant import ACROSS, Slant
from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import FloatArray, IntArray

PIXELS = 96
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
        steps = (self.diagonal * (pixels / self.pixels - 0.5) for pixels in self._pixels)
        across, up = (each.reshape(*self.shape, 1) for each in steps)
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
        from cv2 import INTER_NEAREST, WARP_INVERSE_MAP, warpAffine

        slant, (least, most) = stencil.slant, stencil.box
        faced = self._facing(slant)
        origin = faced.origin + slant.level * faced.rise
        middle, half = faced.turn @ ((least + most) / 2) + origin, np.abs(faced.turn) @ ((most - least) / 2)
        low, high = (np.rint(end).astype(np.int64).clip(0, self.pixels) for end in (middle - half, middle + half))
        cells = np.empty((len(low), 2, 3))  # of columns and rows of pixels, and 1, both counted from their centres
        cells[:, :, :2] = faced.back / stencil.grain[:, None]
        cells[:, :, 2] = (
            (faced.back @ (low + 0.5 - origin)[:, :, None])[:, :, 0] - stencil.low
        ) / stencil.grain - 0.5
        cells = cells[:, ::-1].copy()  # columns of the mask first
        picture = stencil.mask.view(np.uint8)
        canvas = np.zeros((len(self.axes), self.pixels, self.pixels), dtype=np.uint8)
        for view, (x0, y0), (x1, y1), affine in zip(faced.views, low.tolist(), high.tolist(), cells, strict=True):
            if x0 < x1 and y0 < y1:
                seen = canvas[view, y0:y1, x0:x1]
                warpAffine(picture, affine, (x1 - x0, y1 - y0), dst=seen, flags=INTER_NEAREST | WARP_INVERSE_MAP)
        found = np.flatnonzero(canvas.view(np.bool_))
        away = np.zeros((len(self.axes), 3))
        away[faced.views, :2] = faced.deepening
        away[faced.views, 2] = faced.depth - slant.level * faced.height - (faced.deepening * origin).sum(axis=1)
        across, up, constant = np.repeat(away, self._counted(found), axis=0).T
        column, row = (pixels[found] for pixels in self._pixels)
        return found, across * column + up * row + constant

    def _counted(self, found: IntArray) -> IntArray:
        """How many of sorted indices of pixels are of each view, shape (9,)."""
        return np.diff(np.searchsorted(found, self.pixels**2 * np.arange(len(self.axes) + 1)))

    def _facing(self, slant: Slant) -> "Facing":
        """How the views see planes of one slope; there are few slopes."""
        key = slant.axis, *slant.slopes
        if key not in self._facings:
            self._facings[key] = Facing.of(self, slant)
        return self._facings[key]

    @cached_property
    def _facings(self) -> dict[tuple[float, ...], "Facing"]:
        return {}

    @cached_property
    def _pixels(self) -> tuple[FloatArray, FloatArray]:
        """Columns and rows of the centres of the pixels of all views, each of shape (9 p,)."""
        centres = np.arange(self.pixels) + 0.5
        return np.tile(centres, len(self.axes) * self.pixels), np.tile(
            np.repeat(centres, self.pixels), len(self.axes)
        )


class Facing(NamedTuple):
    """How views see the planes of one slope, by the coordinates s and t of a slant.

    Attributes
    ----------
    views:
        Those that do not see them edge on, shape (v,).
    turn, origin, rise:
        The column and row of a point are ``turn @ (s, t) + origin + level * rise``; shapes (v, 2, 2), (v, 2) and
        (v, 2).
    back:
        Inverse of `turn`, shape (v, 2, 2).
    depth, height, deepening:
        A point is ``depth - level * height + deepening @ (pixel - origin - level * rise)`` from the origin of its
        ray, mm; shapes (v,), (v,), (v, 2).
    """

    views: IntArray
    turn: FloatArray
    origin: FloatArray
    rise: FloatArray
    back: FloatArray
    depth: FloatArray
    height: FloatArray
    deepening: FloatArray

    @staticmethod
    def of(views: Views, slant: Slant) -> "Facing":
        """All of this for one slope."""
        equation = slant.equation
        cosine = views.axes[:, 2] @ equation / np.linalg.norm(equation)
        faced = np.flatnonzero(np.abs(cosine) > EDGE_ON)
        axes, scale = views.axes[faced], views.pixels / views.diagonal
        steps = np.zeros((3, 2))
        steps[list(ACROSS[slant.axis]), (0, 1)] = 1.0
        steps[slant.axis] = slant.slopes
        turn = axes[:, :2] @ steps * scale
        back = np.linalg.inv(turn).astype(np.float64)
        deepening = -(axes[:, 2:] @ steps @ back)[:, 0]
        origin = views.pixels / 2 - axes[:, :2] @ views.centre * scale
        depth = views.diagonal + axes[:, 2] @ views.centre
        return Facing(
            faced, turn, origin, axes[:, :2, slant.axis] * scale, back, depth, axes[:, 2, slant.axis], deepening
        )

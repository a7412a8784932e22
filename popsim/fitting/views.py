"""Pixels of nine parallel views of the open card, and where they meet a plane."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from popsim.fitting.kernels.records import Facing, FloatImage
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

    def rays(self) -> tuple[FloatArray, FloatArray]:
        """Origins and directions of the rays of all pixels, view after view, shape (9 p, 3)."""
        steps = self.diagonal * (self.centres / self.pixels - 0.5)
        up, across = (grid.reshape(-1, 1) for grid in np.meshgrid(steps, steps, indexing="ij"))
        right, rise, eye = self.axes[:, None, 0], self.axes[:, None, 1], self.axes[:, None, 2]
        origins = self.centre + across * right + up * rise + self.diagonal * eye
        directions = np.broadcast_to(-eye, origins.shape)
        return origins.reshape(-1, 3), directions.reshape(-1, 3)

    def drawn(self, stencil: Stencil) -> "Picture":
        """Draw a stencil into all views that see its plane."""
        from popsim.fitting.kernels.pictures import drawn

        slant = stencil.slant
        facing = self._facing(slant)
        return Picture(*drawn(stencil.mask, stencil.low, stencil.grain, slant.level, facing, self.pixels))

    @cached_property
    def canvas(self) -> FloatImage:
        """Room for views, shape (views, pixels, pixels); new room would have to be cleared by the system first."""
        return np.empty((len(self.axes), self.pixels, self.pixels), dtype=np.float32)

    def _facing(self, slant: Slant) -> Facing:
        """How the views see planes of one slope; there are few slopes."""
        key = slant.axis, *slant.slopes
        if key not in self._facings:
            self._facings[key] = _faced(self, slant)
        return self._facings[key]

    @cached_property
    def _facings(self) -> dict[tuple[float, ...], Facing]:
        return {}

    @cached_property
    def centres(self) -> FloatArray:
        """Where the centres of the pixels of a row, or of a column, lie, in pixels, shape (pixels,)."""
        return np.arange(self.pixels, dtype=np.float64) + 0.5


def _faced(views: Views, slant: Slant) -> Facing:
    """How views see the planes of the slope of one."""
    equation = slant.equation
    cosine = views.axes[:, 2] @ equation / np.linalg.norm(equation)
    faced = np.flatnonzero(np.abs(cosine) > EDGE_ON)
    axes, scale = views.axes[faced], views.pixels / views.diagonal
    steps = np.zeros((3, 2))
    steps[list(ACROSS[slant.axis]), (0, 1)] = 1.0
    steps[slant.axis] = slant.slopes
    turn = axes[:, :2] @ steps * scale
    back = np.linalg.inv(turn).astype(np.float64)
    return Facing(
        faced,
        turn,
        origin=views.pixels / 2 - axes[:, :2] @ views.centre * scale,
        rise=axes[:, :2, slant.axis] * scale,
        back=back,
        depth=views.diagonal + axes[:, 2] @ views.centre,
        height=axes[:, 2, slant.axis].copy(),
        deepening=-(axes[:, 2:] @ steps @ back)[:, 0],
    )


class Picture(NamedTuple):
    """What shows in rectangles of views.

    Attributes
    ----------
    spans:
        Of each rectangle its view, first row, the one after the last, and the same of columns, shape (k, 5).
    depth:
        How far from the origins of their rays something shows in their pixels, mm, inf where nothing does:
        rectangle after rectangle, row after row, shape (n,).
    """

    spans: IntArray
    depth: FloatImage

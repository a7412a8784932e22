"""Pixels of nine parallel views of the open card, and where they meet a plane."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from popsim.fitting.masks import FAR, FloatImage, drawn
from popsim.fitting.slant import ACROSS, Slant
from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import FloatArray

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
        steps = self.diagonal * (self.centres / self.pixels - 0.5)
        up, across = (grid.reshape(-1, 1) for grid in np.meshgrid(steps, steps, indexing="ij"))
        right, rise, eye = self.axes[:, None, 0], self.axes[:, None, 1], self.axes[:, None, 2]
        origins = self.centre + across * right + up * rise + self.diagonal * eye
        directions = np.broadcast_to(-eye, origins.shape)
        return origins.reshape(-1, 3), directions.reshape(-1, 3)

    def drawn(self, stencil: Stencil) -> "list[Drawn]":
        """Draw a stencil into all views that see its plane."""
        slant, (least, most) = stencil.slant, stencil.box
        faced = self._facing(slant)
        origin = faced.origin + slant.level * faced.rise
        middle, half = faced.turn @ ((least + most) / 2) + origin, faced.spread @ ((most - least) / 2)
        ends = np.rint(np.array([middle - half, middle + half]))
        low, high = np.minimum(np.maximum(ends, 0.0), self.pixels)
        cells = np.empty((len(low), 2, 3))  # columns of the stencil first
        cells[:, :, :2] = faced.back[:, ::-1] / stencil.grain[::-1, None]
        first = (faced.back @ (low + 0.5 - origin)[:, :, None])[:, ::-1, 0]
        cells[:, :, 2] = (first - stencil.low[::-1]) / stencil.grain[::-1] - 0.5
        nearest = faced.depth - slant.level * faced.height - (faced.deepening * origin).sum(axis=1)
        spans = np.concatenate([low, high], axis=1).astype(np.int64).tolist()
        found, picture = [], stencil.picture
        for k, ((x0, y0, x1, y1), near) in enumerate(zip(spans, nearest.astype(np.float32), strict=True)):
            if x0 < x1 and y0 < y1:
                depth = drawn(picture, (y1 - y0, x1 - x0), cells[k])
                depth += faced.across[k][x0:x1] + near
                depth += faced.up[k][y0:y1]
                found.append(Drawn(faced.views[k], slice(y0, y1), slice(x0, x1), depth))
        return found

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
    def centres(self) -> FloatArray:
        """Where the centres of the pixels of a row, or of a column, lie, in pixels, shape (pixels,)."""
        return np.arange(self.pixels, dtype=np.float64) + 0.5


class Drawn(NamedTuple):
    """A rectangle of pixels of a view, and how far from the origins of their rays something shows in them.

    Attributes
    ----------
    view:
        Index of the view.
    rows, columns:
        Its pixels.
    depth:
        mm, inf where nothing shows, shape (rows, columns).
    """

    view: int
    rows: slice
    columns: slice
    depth: FloatImage


class Facing(NamedTuple):
    """How views see the planes of one slope, by the coordinates s and t of a slant.

    Attributes
    ----------
    views:
        Those that do not see them edge on, shape (v,).
    turn, origin, rise:
        The column and row of a point are ``turn @ (s, t) + origin + level * rise``; shapes (v, 2, 2), (v, 2) and
        (v, 2).
    spread:
        The same as `turn` without signs: columns and rows over which a rectangle spreads.
    back:
        Inverse of `turn`, shape (v, 2, 2).
    depth, height, deepening:
        A point is ``depth - level * height + deepening @ (pixel - origin - level * rise)`` from the origin of its
        ray, mm; shapes (v,), (v,), (v, 2).
    across, up:
        By how much it deepens up to each column, mm, shapes (pixels,), and up to each row, shapes (pixels, 1).
    """

    views: list[int]
    turn: FloatArray
    spread: FloatArray
    origin: FloatArray
    rise: FloatArray
    back: FloatArray
    depth: FloatArray
    height: FloatArray
    deepening: FloatArray
    across: list[FloatImage]
    up: list[FloatImage]

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
        rise, height = axes[:, :2, slant.axis] * scale, axes[:, 2, slant.axis]
        across, up = (deepening[:, :, None] * views.centres).astype(np.float32).swapaxes(0, 1)
        ramps = list(across), list(up[:, :, None])
        return Facing(faced.tolist(), turn, np.abs(turn), origin, rise, back, depth, height, deepening, *ramps)


def flattened(pictures: Iterable[Drawn]) -> list[Drawn]:
    """Rectangles of views as one for each view: what is nearest in each pixel."""
    views: dict[int, list[Drawn]] = {}
    for picture in pictures:
        views.setdefault(picture.view, []).append(picture)
    return [own[0] if len(own) == 1 else _nearest(own) for own in views.values()]


def _nearest(pictures: Sequence[Drawn]) -> Drawn:
    """Rectangles of one view as one."""
    top, left = (min(span.start for span in spans) for spans in zip(*(own[1:3] for own in pictures), strict=True))
    end, right = (max(span.stop for span in spans) for spans in zip(*(own[1:3] for own in pictures), strict=True))
    depth = np.full((end - top, right - left), FAR)
    for _, rows, columns, there in pictures:
        part = depth[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left]
        np.minimum(part, there, out=part)
    return Drawn(pictures[0].view, slice(top, end), slice(left, right), depth)

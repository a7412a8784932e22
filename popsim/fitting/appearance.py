"""How much an abstraction looks like its model, from all sides, before any contour is cut.

The plates stand as they would open, cut as contours will cut them: seen along the axis that a plate faces most, it
shows where the model lies no deeper behind it than it shows, and beyond its face, within its room, where the model
lies near.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.fitting.drawing import Drawing
from popsim.fitting.fronts import Fronts
from popsim.fitting.masks import FloatImage
from popsim.fitting.views import PIXELS, Views
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.mechanisms import AS_THEY_ARE, Depths, Mechanism

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

DEEP = 0.04
"""Share of the diagonal by which depths may differ and still count as the same surface."""

GRAIN = 0.006
"""Side of the cells of stencils, as a share of the diagonal: gaps up to about that are closed."""

OUTLINE, DEPTH = 2 / 3, 1 / 3
"""Weights of silhouette and relief: an outline that is wrong is seen first."""

NEARNESS = 0.03
"""Weight of the offset: enough to tell apart what pixels alone do not."""


@dataclass(frozen=True)
class Likeness:
    """Shares of what either shows that both show (silhouette), and at the same depth (relief), 0..1.

    `offset` is how far depths differ on average where both show, as a share of what relief allows, 0..1.
    """

    silhouette: float
    relief: float
    offset: float

    @property
    def overall(self) -> float:
        """The weighted mean of both; of equals, that whose surfaces lie nearer to the model's."""
        return OUTLINE * self.silhouette + DEPTH * self.relief - NEARNESS * self.offset


class Appearance:
    """A model seen from all sides, to hold abstractions against; `fineness` times as many pixels a side."""

    def __init__(self, scene: "RayScene", bounds: FloatArray, fineness: int = 1) -> None:
        self.scene, self.bounds = scene, bounds
        self.views = Views.of(bounds, fineness * PIXELS)
        self.grain = GRAIN * self.views.diagonal / fineness

    def likeness(self, mechanisms: Sequence[Mechanism], depths: Depths = AS_THEY_ARE) -> Likeness:
        """Compare mechanisms with the model, with factors on the depths of their plates."""
        depth, half = self._drawing.drawn(mechanisms, depths)
        model = self._half if half else self._model
        apart = np.abs(depth.reshape(-1).take(model.pixels) - model.depth)
        apart *= np.float32(1 / (DEEP * self.views.diagonal))
        both = np.isfinite(apart)
        silhouette = model.counted(both)
        union = np.array([np.count_nonzero(np.isfinite(own)) for own in depth]) + model.counts - silhouette
        shares = silhouette, model.counted(apart <= 1), model.summed(np.minimum(apart, both))
        return Likeness(*(float(model.weights @ (share / union)) for share in shares))

    def look(self) -> None:
        """Look at the model now rather than when it is first asked for."""
        _ = self._distance, self._drawing

    @cached_property
    def _drawing(self) -> Drawing:
        return Drawing(self.views, Fronts.of(self.scene, self.bounds, self.grain))

    @cached_property
    def _distance(self) -> FloatArray:
        """How far the model is in all pixels of the views, shape (views, n)."""
        return self.scene.hit(*self.views.rays()).distance.reshape(self.views.shape)

    @cached_property
    def _model(self) -> "Shown":
        return Shown.of(self._distance, np.ones(len(self._distance)))

    @cached_property
    def _half(self) -> "Shown":
        """The model in the views that tell all where both sides of the fold look alike."""
        assert self._drawing.mirror is not None
        return Shown.of(self._distance[list(self._drawing.mirror.once)], self._drawing.mirror.weights)


class Shown(NamedTuple):
    """Where a model shows in views.

    Attributes
    ----------
    pixels, depth:
        Its pixels, view after view, and how deep it lies in them, mm, each of shape (k,).
    views:
        Those of each view.
    counts:
        How many these are, shape (views,).
    weights:
        What each view counts, shape (views,); 1 together.
    """

    pixels: IntArray
    depth: FloatImage
    views: tuple[slice, ...]
    counts: IntArray
    weights: FloatArray

    @staticmethod
    def of(distance: FloatArray, weights: FloatArray) -> "Shown":
        """From the depths of all pixels of some views, shape (views, n), inf where there is no model."""
        shape, distance = distance.shape, distance.reshape(-1)
        pixels = np.flatnonzero(np.isfinite(distance))
        ends = np.searchsorted(pixels, shape[1] * np.arange(shape[0] + 1))
        views = tuple(slice(first, last) for first, last in pairwise(ends.tolist()))
        return Shown(pixels, distance[pixels].astype(np.float32), views, np.diff(ends), weights / weights.sum())

    def counted(self, which: BoolArray) -> IntArray:
        """How many pixels of each view a mask of all pixels holds."""
        return np.array([np.count_nonzero(which[own]) for own in self.views])

    def summed(self, values: FloatImage) -> FloatArray:
        """Sums over the pixels of each view of one value for each pixel."""
        return np.array([values[own].sum(dtype=np.float64) for own in self.views])

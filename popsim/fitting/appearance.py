"""How much an abstraction looks like its model, from all sides, before any contour is cut.

The plates stand as they would open, cut as contours will cut them: seen along the axis that a plate faces most, it
shows where the model lies no deeper behind it than it shows, and beyond its face, within its room, where the model
lies near.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.fitting.drawing import Drawing
from popsim.fitting.fronts import Fronts
from popsim.fitting.kernels.records import FloatImage
from popsim.fitting.views import PIXELS, Views
from popsim.geometry.arrays import FloatArray
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
        from popsim.fitting.kernels.pictures import compared

        depth, half = self._drawing.drawn(mechanisms, depths)
        model, weights = self._half if half else (self._distance, np.ones(len(depth)))
        either, both, same, apart = compared(depth, model, DEEP * self.views.diagonal).T
        return Likeness(*(float(weights @ (share / either) / weights.sum()) for share in (both, same, apart)))

    def look(self) -> None:
        """Look at the model now rather than when it is first asked for: a second process cannot send rays."""
        _ = self._distance, self._drawing

    @property
    def fronts(self) -> Fronts:
        """The model as it looks along the axes."""
        return self._drawing.fronts

    @cached_property
    def _drawing(self) -> Drawing:
        return Drawing(self.views, Fronts.of(self.scene, self.bounds, self.grain))

    @cached_property
    def _distance(self) -> FloatImage:
        """How far the model is in all pixels of the views, shape (views, n, n)."""
        found = self.scene.hit(*self.views.rays()).distance.astype(np.float32)
        return found.reshape(-1, self.views.pixels, self.views.pixels)

    @cached_property
    def _half(self) -> tuple[FloatImage, FloatArray]:
        """The model in the views that tell all where both sides of the fold look alike, and what each counts."""
        assert self._drawing.mirror is not None
        return self._distance[self._drawing.mirror.once], self._drawing.mirror.weights

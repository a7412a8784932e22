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

from popsim.fitting.fronts import Fronts
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import PIXELS, Drawn, Views
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.mechanisms import AS_THEY_ARE, Depths, Mechanism, Plate, plates_together

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

DEEP = 0.04
"""Share of the diagonal by which depths may differ and still count as the same surface."""

REMEMBERED = 4000
"""Plates whose pictures are kept; candidates differ in few of them."""

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
        self.known: dict[bytes, list[Drawn]] = {}

    def likeness(self, mechanisms: Sequence[Mechanism], depths: Depths = AS_THEY_ARE) -> Likeness:
        """Compare mechanisms with the model, with factors on the depths of their plates."""
        depth = np.full((len(self.views.axes), self.views.pixels, self.views.pixels), np.inf, dtype=np.float32)
        for own in plates_together(mechanisms, depths).values():
            for plate in own:
                for view, rows, columns, there in self._picture(plate):
                    part = depth[view, rows, columns]
                    np.minimum(part, there, out=part)
        pixels, views, model = self._model
        apart = np.abs(depth.reshape(-1)[pixels] - model) / (DEEP * self.views.diagonal)
        both, shown = np.isfinite(apart), np.isfinite(depth).sum(axis=(1, 2))
        union = shown + np.bincount(views[~both], minlength=len(depth))

        def share(values: FloatArray | BoolArray) -> float:
            return float((np.bincount(views, weights=values, minlength=len(depth)) / union).mean())

        return Likeness(share(both), share(apart <= 1), share(np.where(both, np.minimum(apart, 1), 0)))

    @cached_property
    def _model(self) -> tuple[IntArray, IntArray, FloatArray]:
        """Pixels of all views in which the model shows, the view of each, and its depth there, each (k,)."""
        distance = self.scene.hit(*self.views.rays()).distance
        pixels = np.flatnonzero(np.isfinite(distance))
        return pixels, pixels // self.views.shape[1], distance[pixels]

    @cached_property
    def _fronts(self) -> Fronts:
        return Fronts.of(self.scene, self.bounds, self.grain)

    def _picture(self, plate: Plate) -> list[Drawn]:
        """A plate in all views as contours will leave it."""
        assert plate.room is not None  # plates give themselves room
        depths = np.array([plate.behind, plate.beside])
        key = plate.outline.tobytes() + plate.room.tobytes() + plate.outward.tobytes() + depths.tobytes()
        found = self.known.get(key)
        if found is None:
            found = self.views.drawn(Stencil.of(plate, self._fronts))
            if len(self.known) >= REMEMBERED:
                self.known.pop(next(iter(self.known)))
            self.known[key] = found
        return found

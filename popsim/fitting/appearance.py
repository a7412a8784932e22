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
from popsim.fitting.views import PIXELS, Views
from popsim.geometry.arrays import FloatArray
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
        self.known: dict[bytes, tuple[FloatArray, FloatArray]] = {}

    def likeness(self, mechanisms: Sequence[Mechanism], depths: Depths = AS_THEY_ARE) -> Likeness:
        """Compare mechanisms with the model, with factors on the depths of their plates."""
        plates = plates_together(mechanisms, depths).values()
        pictures = [self._picture(plate) for own in plates for plate in own]
        depth = np.full(self._model_depth.size, np.inf, dtype=np.float32)
        pixels, ahead = (np.concatenate([picture[k] for picture in pictures]) for k in (0, 1))
        np.minimum.at(depth, pixels, ahead)
        model, shown = self._model_depth, np.isfinite(depth).reshape(self.views.shape)
        seen = np.isfinite(model)
        both, union = shown & seen, (shown | seen).sum(axis=1)
        apart = np.zeros(model.shape)
        np.subtract(depth.reshape(model.shape), model, out=apart, where=both)
        apart = np.abs(apart) / (DEEP * self.views.diagonal)
        shares = [
            (pixels.sum(axis=1) / union).mean() for pixels in (both, both & (apart <= 1), np.minimum(apart, 1))
        ]
        return Likeness(float(shares[0]), float(shares[1]), float(shares[2]))

    @cached_property
    def _model_depth(self) -> FloatArray:
        """Depth of the model per view and pixel, inf where empty, shape (9, p)."""
        return self.scene.hit(*self.views.rays()).distance.reshape(self.views.shape)

    @cached_property
    def _fronts(self) -> Fronts:
        return Fronts.of(self.scene, self.bounds, self.grain)

    def _picture(self, plate: Plate) -> tuple[FloatArray, FloatArray]:
        """Pixels of all views in which a plate shows as contours will leave it, and its depth there."""
        assert plate.room is not None  # plates give themselves room
        depths = np.array([plate.behind, plate.beside])
        key = plate.outline.tobytes() + plate.room.tobytes() + plate.outward.tobytes() + depths.tobytes()
        found = self.known.get(key)
        if found is None:
            pixels, depth = self.views.drawn(Stencil.of(plate, self._fronts))
            found = pixels.astype(np.int32), depth.astype(np.float32)
            if len(self.known) >= REMEMBERED:
                self.known.pop(next(iter(self.known)))
            self.known[key] = found
        return found

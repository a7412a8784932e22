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
from popsim.fitting.views import Views
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.plane import Plane
from popsim.mechanisms import AS_THEY_ARE, Depths, Mechanism, Plate, plates_together

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

DEEP = 0.04
"""Share of the diagonal by which depths may differ and still count as the same surface."""

REMEMBERED = 4000
"""Plates whose pictures are kept; candidates differ in few of them."""

SPARSE = 0.25
"""A face on which the model shows on less than this share stays whole: its hinges need paper to hold."""

GRAIN = 0.008
"""Share of the diagonal up to about which parts of a plate hang together."""

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
    """A model seen from all sides, to hold abstractions against."""

    def __init__(self, scene: "RayScene", bounds: FloatArray) -> None:
        self.scene, self.bounds = scene, bounds
        self.views = Views.of(bounds)
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
        return Fronts.of(self.scene, self.bounds)

    def _picture(self, plate: Plate) -> tuple[FloatArray, FloatArray]:
        """Pixels of all views in which a plate shows as contours will leave it, and its depth there."""
        assert plate.room is not None  # plates give themselves room
        depths = np.array([plate.behind, plate.beside])
        key = plate.outline.tobytes() + plate.room.tobytes() + plate.outward.tobytes() + depths.tobytes()
        found = self.known.get(key)
        if found is None:
            found = self._drawn(plate, plate.room)
            if len(self.known) >= REMEMBERED:
                self.known.pop(next(iter(self.known)))
            self.known[key] = found
        return found

    def _drawn(self, plate: Plate, room: FloatArray) -> tuple[FloatArray, FloatArray]:
        plane = Plane.through(plate.outline)
        pixels, points, depth = self.views.cast(np.concatenate([plate.outline, room]), plane.normal)
        face, beyond = self._shown(plate, plane, points)
        if beyond.any():
            beyond &= self._attached(plate, plane, plane.flat(points))
        shown = face | beyond
        return pixels[shown].astype(np.int32), depth[shown].astype(np.float32)

    def _shown(self, plate: Plate, plane: Plane, points: FloatArray) -> tuple[BoolArray, BoolArray]:
        """At which points (n, 3) of its plane a plate shows the model within its face, and beyond it."""
        assert plate.room is not None  # plates give themselves room
        behind = self._fronts.behind(points, plate.outward)
        flat = plane.flat(points)
        face = _within(flat, plane.flat(plate.outline))
        shown = face & np.isfinite(behind) & (behind <= plate.behind)
        if plate.principal and shown.sum() < SPARSE * face.sum():
            shown = face
        beside = behind <= plate.beside
        if not plate.principal:
            beside &= self._fronts.behind(points, -plate.outward) <= plate.beside
        return shown, beside & ~face & _within(flat, plane.flat(plate.room))

    def _attached(self, plate: Plate, plane: Plane, flat: FloatArray) -> BoolArray:
        """At which points (n, 2) of its plane what a plate would show hangs together with its face."""
        from scipy.ndimage import binary_dilation, label

        assert plate.room is not None  # plates give themselves room
        corners = plane.flat(np.concatenate([plate.outline, plate.room]))
        low, grain = corners.min(axis=0), GRAIN * self.views.diagonal
        shape = np.ceil((corners.max(axis=0) - low) / grain).astype(np.int64) + 1
        cells = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 2)
        face, beyond = self._shown(plate, plane, plane.lift(low + (cells + 0.5) * grain))
        parts, _ = label(binary_dilation((face | beyond).reshape(shape)))
        joined = np.unique(parts[face.reshape(shape)])
        x, y = np.clip(((flat - low) / grain).astype(np.int64), 0, shape - 1).T
        return np.isin(parts[x, y], joined)


def _within(points: FloatArray, ring: FloatArray) -> BoolArray:
    """Whether points (n, 2) lie in a simple polygon (m, 2)."""
    x, y = points.T
    inside = np.zeros(len(points), dtype=bool)
    for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        if y0 == y1:
            continue
        crosses = (y0 > y) != (y1 > y)
        inside ^= crosses & (x < x0 + (y - y0) * ((x1 - x0) / (y1 - y0)))
    return inside

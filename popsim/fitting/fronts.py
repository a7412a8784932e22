"""The model seen along the three axes from both ends: what the contours of plates will be cut after."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.fitting.kernels.records import Ends
from popsim.fitting.slant import ACROSS
from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

UNLIKE = 0.005
"""Share of what two models show along the axes that may differ, for them to be the same."""

SHIFTED = 1e-6
"""By how much, as a share of its size, a box may lie elsewhere and still count as the same."""


@dataclass(frozen=True, eq=False)
class Fronts:
    """How far out the model reaches along each axis.

    Attributes
    ----------
    bounds:
        The box in which it is looked at, rows low and high, shape (2, 3), mm.
    pixel:
        Side of a pixel, mm.
    maps:
        By axis, then by end (high end first): least distance from that end, as a coordinate times the sign of the
        end, -inf where there is no model; indexed by the pixels of the other axes, with one more, without model,
        on all sides of the box.
    start:
        Corner at which the pixels begin, shape (3,): they are as far beyond the box at its other end.
    """

    bounds: FloatArray
    pixel: float
    maps: tuple[tuple[FloatArray, FloatArray], ...]
    start: FloatArray

    @staticmethod
    def of(scene: "RayScene", bounds: FloatArray, pixel: float) -> "Fronts":
        """Look at a model in a box with pixels of a given side, mm."""
        size = bounds[1] - bounds[0]
        counts = np.ceil(size / pixel)
        start = bounds.mean(axis=0) - counts / 2 * pixel
        far = float(np.abs(bounds).max() + size.max())
        maps = []
        for axis, (first, second) in enumerate(ACROSS):
            grid = [start[k] + (np.arange(counts[k]) + 0.5) * pixel for k in (first, second)]
            a, b = np.meshgrid(*grid, indexing="ij")
            origins = np.empty((a.size, 3))
            origins[:, first], origins[:, second] = a.ravel(), b.ravel()
            ends = []
            for sign in (1.0, -1.0):
                origins[:, axis] = sign * far
                direction = np.zeros((1, 3))
                direction[0, axis] = -sign
                reach = (far - scene.hit(origins, direction).distance).reshape(a.shape)
                ends.append(np.pad(reach, 1, constant_values=-np.inf))
            maps.append((ends[0], ends[1]))
        return Fronts(bounds, pixel, tuple(maps), start)

    def ends(self, axis: int, sign: int) -> Ends:
        """How far out the model reaches along an axis (0 x, 1 y, 2 z), seen from its high (1) or low (-1) end."""
        return self._ends[axis][0 if sign > 0 else 1]

    def same_as(self, other: "Fronts") -> bool:
        """Whether another model, or this one over another fold, looks the same along all axes."""
        if np.abs(self.bounds - other.bounds).max() > SHIFTED * np.ptp(self.bounds, axis=0).max():
            return False
        pairs = zip(self.maps, other.maps, strict=True)
        return alike([pair for ends in pairs for pair in zip(*ends, strict=True)], self.pixel)

    @cached_property
    def _ends(self) -> tuple[tuple[Ends, Ends], ...]:
        found = []
        for axis, (high, low) in enumerate(self.maps):
            across = list(ACROSS[axis])
            bounds, start = self.bounds[:, across].copy(), self.start[across]
            found.append(
                (
                    Ends(bounds, start, self.pixel, near=high, far=low, sign=1),
                    Ends(bounds, start, self.pixel, near=low, far=high, sign=-1),
                )
            )
        return tuple(found)


def alike(pairs: Sequence[tuple[FloatArray, FloatArray]], pixel: float) -> bool:
    """Whether of each two maps one shows what the other does, but for little."""
    if any(one.shape != other.shape for one, other in pairs):
        return False
    unlike = sum(_unlike(one, other, pixel) for one, other in pairs)
    return unlike <= UNLIKE * sum(np.count_nonzero(np.isfinite(one)) for one, _ in pairs)


def _unlike(one: FloatArray, other: FloatArray, pixel: float) -> int:
    """In how many pixels only one of two maps shows something, or both at depths farther apart than a pixel."""
    shown, also = np.isfinite(one), np.isfinite(other)
    with np.errstate(invalid="ignore"):  # where both show nothing
        apart = np.abs(one - other) > pixel
    return int(np.count_nonzero((shown != also) | (shown & also & apart)))

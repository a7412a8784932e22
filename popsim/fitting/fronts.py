"""The model seen along the three axes from both ends: what the contours of plates will be cut after."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

PIXELS = 160
"""Pixels along the longest side of the model."""


@dataclass(frozen=True, eq=False)
class Fronts:
    """How far out the model reaches along each axis.

    Attributes
    ----------
    low:
        Corner where the pixels start, shape (3,), mm.
    pixel:
        Side of a pixel, mm.
    maps:
        By axis, then by end (high end first): least distance from that end, as a coordinate times the sign of the
        end, -inf where there is no model; indexed by the pixels of the other axes.
    """

    low: FloatArray
    pixel: float
    maps: tuple[tuple[FloatArray, FloatArray], ...]

    @staticmethod
    def of(scene: "RayScene", bounds: FloatArray) -> "Fronts":
        """Look at a model in a box, rows low and high, shape (2, 3)."""
        low, size = bounds[0], bounds[1] - bounds[0]
        pixel = float(size.max()) / PIXELS
        far = float(np.abs(bounds).max() + size.max())
        maps = []
        for axis in range(3):
            first, second = (k for k in range(3) if k != axis)
            grid = [low[k] + (np.arange(int(np.ceil(size[k] / pixel)) + 1) + 0.5) * pixel for k in (first, second)]
            a, b = np.meshgrid(*grid, indexing="ij")
            origins = np.empty((a.size, 3))
            origins[:, first], origins[:, second] = a.ravel(), b.ravel()
            ends = []
            for sign in (1.0, -1.0):
                origins[:, axis] = sign * far
                direction = np.zeros((1, 3))
                direction[0, axis] = -sign
                ends.append((far - scene.hit(origins, direction).distance).reshape(a.shape))
            maps.append((ends[0], ends[1]))
        return Fronts(low, pixel, tuple(maps))

    def behind(self, points: FloatArray, outward: FloatArray) -> FloatArray:
        """How far behind points (n, 3) the model lies, seen from the end of the axes that `outward` faces most.

        Negative where it lies before them, inf where there is none, mm, shape (n,).
        """
        axis = int(np.abs(outward).argmax())
        sign = 1 if outward[axis] > 0 else -1
        front = self.maps[axis][0 if sign > 0 else 1]
        cells = np.floor((points - self.low) / self.pixel).astype(np.int64)
        first, second = (cells[:, k] for k in range(3) if k != axis)
        inside = (first >= 0) & (first < front.shape[0]) & (second >= 0) & (second < front.shape[1])
        reach = np.full(len(points), -np.inf)
        reach[inside] = front[first[inside], second[inside]]
        return np.asarray(sign * points[:, axis] - reach)

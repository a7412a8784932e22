"""The model seen along the three axes from both ends: what the contours of plates will be cut after."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.fitting.slant import ACROSS
from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene


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

    def reach(self, axis: int, sign: int, s: FloatArray, t: FloatArray) -> FloatArray:
        """How far out the model reaches towards an end of an axis, as in `maps`, over a grid.

        Parameters
        ----------
        axis, sign:
            0 x, 1 y, 2 z; 1 for its high end, -1 for its low one.
        s, t:
            Coordinates along the other axes of the rows and columns of the grid, shapes (r,) and (c,).

        Returns
        -------
        numpy.ndarray
            Shape (r, c).
        """
        found = self.maps[axis][0 if sign > 0 else 1]
        for place, (across, values) in enumerate(zip(ACROSS[axis], (s, t), strict=True)):
            cells = np.floor((values - self.start[across]) / self.pixel).astype(np.int64) + 1
            found = found.take(cells, axis=place, mode="clip")
        return found

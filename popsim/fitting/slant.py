"""A plane seen along the axis that it faces most, where two coordinates of the card frame name its points."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray

ACROSS = ((1, 2), (0, 2), (0, 1))
"""The other two axes, by axis,"""

SEEN = (slice(1, 3), slice(0, 3, 2), slice(0, 2))
"""and how they lie in a row of three."""


@dataclass(frozen=True, eq=False)
class Slant:
    """A plane as a function of two coordinates.

    Attributes
    ----------
    axis:
        0 x, 1 y, 2 z: the axis that the plane faces most.
    sign:
        1 where it faces the high end of the axis, else -1.
    level, slopes:
        Its coordinate along the axis is ``level + slopes @ (s, t)``, with s and t along the other two axes.
    """

    axis: int
    sign: int
    level: float
    slopes: tuple[float, float]

    @staticmethod
    def of(outward: FloatArray, point: FloatArray) -> "Slant":
        """The plane through a point with a normal, both of shape (3,)."""
        normal, place = outward.tolist(), point.tolist()
        axis = max(range(3), key=lambda k: abs(normal[k]))
        first, second = ACROSS[axis]
        slopes = -normal[first] / normal[axis], -normal[second] / normal[axis]
        level = place[axis] - slopes[0] * place[first] - slopes[1] * place[second]
        return Slant(axis, 1 if normal[axis] > 0 else -1, level, slopes)

    @property
    def equation(self) -> FloatArray:
        """A normal (3,) whose product with each point of the plane is `level`."""
        normal = np.ones(3)
        normal[list(ACROSS[self.axis])] = -self.slopes[0], -self.slopes[1]
        return normal

    def seen(self, points: FloatArray) -> FloatArray:
        """Coordinates s and t of points (..., 3); shape (..., 2), contiguous, as kernels are compiled for."""
        return np.ascontiguousarray(points[..., SEEN[self.axis]])

    def along(self, s: FloatArray, t: FloatArray) -> FloatArray:
        """Coordinate along the axis; any shapes that broadcast."""
        return np.asarray(self.level + self.slopes[0] * s + self.slopes[1] * t)

"""Parts as the assembly checks them: outlines taken in or let out by a hair, and points all over them."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.plane import Plane
from popsim.layout import Part

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

HAIR = 0.5
"""mm; outlines are taken in by this, so that parts that meet in a line do not count as crossing."""

SPACING = 10.0
"""mm between points of an outline; smaller paper is still met by its corners."""

COARSE = 0.3
"""mm; outlines are simplified by this much: below what anybody cuts by hand."""


@dataclass(frozen=True, eq=False)
class Outline:
    """The outline of a part in the open pose, for what runs into it and for what looks past it.

    Attributes
    ----------
    plane:
        Plane of the part.
    polygon:
        The outline taken in by HAIR, holes left free, in flat coordinates.
    opaque:
        The outline let out by HAIR: nothing is seen through the gap along a crease.
    points:
        Points along its rings and one inside, shape (m, 3).
    """

    plane: Plane
    polygon: "BaseGeometry"
    opaque: "BaseGeometry"
    points: FloatArray

    @staticmethod
    def of(part: Part) -> "Outline":
        """The outline of `part`."""
        import shapely

        polygon = part.polygon.buffer(-HAIR, join_style="mitre").simplify(COARSE)
        inside = part.polygon.representative_point()
        rings = shapely.segmentize(polygon.boundary, SPACING)
        flat = np.vstack([shapely.get_coordinates(rings), shapely.get_coordinates(inside)])
        opaque = part.polygon.buffer(HAIR, join_style="mitre").simplify(COARSE)
        shapely.prepare([polygon, opaque])
        return Outline(part.plane, polygon, opaque, part.plane.lift(flat))

    @cached_property
    def frame(self) -> FloatArray:
        """Axes u and v of the plane, its normal and its origin, shape (4, 3)."""
        return np.array([self.plane.u, self.plane.v, self.plane.normal, self.plane.origin])

    @cached_property
    def middle(self) -> FloatArray:
        """Middle of a circle around the paper, in flat coordinates, shape (2,)."""
        return np.asarray(self._rim.min(axis=0) / 2 + self._rim.max(axis=0) / 2)

    @cached_property
    def radius(self) -> float:
        """Radius of that circle, mm."""
        return float(np.linalg.norm(self._rim - self.middle, axis=1).max())

    @cached_property
    def _rim(self) -> FloatArray:
        """Corners of `opaque`, shape (k, 2)."""
        import shapely

        return np.asarray(shapely.get_coordinates(self.opaque))

    def covers(self, points: FloatArray) -> BoolArray:
        """Which points (n, 3), taken into the plane, lie well within the paper, shape (n,)."""
        import shapely

        flat = self.plane.flat(points)
        return np.asarray(shapely.contains_xy(self.polygon, flat[:, 0], flat[:, 1]))

"""Planes in space and the flat coordinates of what lies in them."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked

if TYPE_CHECKING:
    from shapely.geometry import Polygon

STEEP = 0.9
"""A normal with |z| above this counts as vertical when in-plane axes are chosen."""


PARALLEL = 1e-9
"""Sine of the angle below which two planes are parallel."""


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane with in-plane axes; all arrays have shape (3,), the axes are orthonormal."""

    origin: FloatArray
    u: FloatArray
    v: FloatArray

    def __post_init__(self) -> None:
        for name in ("origin", "u", "v"):
            object.__setattr__(self, name, locked(getattr(self, name), (3,), f"plane {name}"))

    @cached_property
    def normal(self) -> FloatArray:
        """Unit normal u x v."""
        return locked(_cross(self.u, self.v), (3,), "normal")

    @staticmethod
    def through(ring: FloatArray) -> "Plane":
        """Plane of a closed ring of points (n, 3), counterclockwise about its normal.

        u is horizontal, and v points upward (or, in horizontal planes, u is the x axis).

        Raises
        ------
        GeometryError
            The ring encloses no area.
        """
        points = np.asarray(ring, float)
        normal = area_vector(points)
        length = float(np.linalg.norm(normal))
        extent = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
        if not length > 1e-12 * max(extent, 1e-12) ** 2:
            raise GeometryError("the outline encloses no area; give at least three points not on one line")
        return Plane.facing(normal / length, points[0])

    @staticmethod
    def facing(normal: FloatArray, origin: FloatArray) -> "Plane":
        """Plane through `origin` with unit `normal`; u horizontal, v up where that can be said."""
        up = np.array([0.0, 0.0, 1.0]) if abs(normal[2]) < STEEP else np.array([0.0, np.sign(normal[2]), 0.0])
        u = _cross(up, normal)
        u /= np.linalg.norm(u)
        return Plane(origin, u, _cross(normal, u))

    def moved(self, pose: FloatArray) -> "Plane":
        """The plane moved by a rigid motion (4, 4); flat coordinates stay what they are."""
        turn = np.asarray(pose)[:3, :3]
        return Plane(turn @ self.origin + pose[:3, 3], turn @ self.u, turn @ self.v)

    def flat(self, points: FloatArray) -> FloatArray:
        """Coordinates along u and v of points (..., 3); shape (..., 2)."""
        rel = np.asarray(points, float) - self.origin
        return np.stack([rel @ self.u, rel @ self.v], axis=-1)

    def lift(self, points: FloatArray) -> FloatArray:
        """Points (..., 3) of flat coordinates (..., 2)."""
        flat = np.asarray(points, float)
        return np.asarray(self.origin + flat[..., :1] * self.u + flat[..., 1:2] * self.v)

    def distance(self, points: FloatArray) -> FloatArray:
        """Signed distance of points (..., 3) from the plane, along its normal."""
        return np.asarray((np.asarray(points, float) - self.origin) @ self.normal)

    def polygon(self, outline: FloatArray, holes: tuple[FloatArray, ...] = ()) -> "Polygon":
        """Shapely polygon of an outline (n, 3) and holes, in flat coordinates."""
        from shapely.geometry import Polygon

        return Polygon(self.flat(outline), [self.flat(hole) for hole in holes])


def area_vector(ring: FloatArray) -> FloatArray:
    """Twice the area of a ring (n, 3) times its normal (Newell), shape (3,)."""
    points = np.asarray(ring, float)
    rel = points[1:] - points[:1]
    m = rel[:-1].T @ rel[1:]
    return np.array([m[1, 2] - m[2, 1], m[2, 0] - m[0, 2], m[0, 1] - m[1, 0]])


def line_distance(points: FloatArray, axis: FloatArray) -> FloatArray:
    """Distance of points (..., 3) from the endless line through axis (2, 3)."""
    start = axis[0]
    direction = axis[1] - start
    direction = direction / np.linalg.norm(direction)
    rel = np.asarray(points, float) - start
    return np.asarray(np.linalg.norm(rel - (rel @ direction)[..., None] * direction, axis=-1))


def path_length(points: FloatArray) -> float:
    """Length of the path through points (n, d), mm."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def common_line(one: Plane, other: Plane) -> FloatArray:
    """Two points, 1 apart, of the line that two planes share, shape (2, 3).

    Raises
    ------
    GeometryError
        The planes are parallel.
    """
    along = _cross(one.normal, other.normal)
    length = float(np.linalg.norm(along))
    if length < PARALLEL:
        raise GeometryError("two parallel planes have no line in common; give planes that meet")
    along /= length
    rows = np.array([one.normal, other.normal, along])
    middle = (one.origin + other.origin) / 2
    start = np.linalg.solve(rows, [one.normal @ one.origin, other.normal @ other.origin, along @ middle])
    return np.array([start, start + along])


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross product of two vectors (3,); numpy's own takes ten times as long for one pair."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])

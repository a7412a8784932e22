"""Closed solids as triangles, shape (m, 3, 3), counter-clockwise seen from outside."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from modelling.mesh import FloatArray
from modelling.polygon import Point, ear_clipped

_THINNEST = 1e-9  # area below which a triangle counts as collapsed (apex of a pyramid)
_PLANES = {"x": (2, 1), "y": (0, 2), "z": (0, 1)}  # axes of a profile that is extruded along the key


def loft(sections: Sequence[npt.ArrayLike]) -> FloatArray:
    """Return the solid through `sections`, closed rings of k points each (s, k, 3), with both ends capped.

    The end rings must be planar. A ring may collapse to a point or a line: the tip of a pyramid, a ridge.
    """
    rings = np.asarray(sections, dtype=np.float64)
    parts = [_band(a, b) for a, b in pairwise(rings)]
    parts += [_cap(rings[0])[:, ::-1], _cap(rings[-1])]
    triangles = np.concatenate(parts)
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    triangles = triangles[np.linalg.norm(cross, axis=1) > 2 * _THINNEST]
    volume = np.einsum("mi,mi->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2]))
    return np.asarray(triangles if volume > 0 else triangles[:, ::-1], dtype=np.float64)


def prism(profile: Sequence[Point], axis: str, start: float, end: float) -> FloatArray:
    """Return `profile` extruded along `axis` from `start` to `end`.

    The profile holds (z, y) points for axis x, (x, z) for axis y and (x, y) for axis z. It may be concave.
    """
    ring = np.zeros((len(profile), 3))
    ring[:, _PLANES[axis]] = profile
    shift = np.eye(3)["xyz".index(axis)]
    return loft([ring + start * shift, ring + end * shift])


def box(low: Sequence[float], high: Sequence[float]) -> FloatArray:
    """Return the axis-parallel box between two corners."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    return prism([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], "z", z0, z1)


def cylinder(radius: float, axis: str, start: float, end: float, segments: int = 24) -> FloatArray:
    """Return a cylinder about a coordinate axis."""
    return prism(circle(radius, segments), axis, start, end)


def rounds(heights: Sequence[float], radii: Sequence[float], axis: str, segments: int = 24) -> FloatArray:
    """Return the solid of revolution with `radii` at `heights` along a coordinate `axis`."""
    shift = np.eye(3)["xyz".index(axis)]
    sections = []
    for height, radius in zip(heights, radii, strict=True):
        ring = np.zeros((segments, 3))
        ring[:, _PLANES[axis]] = circle(radius, segments)
        sections.append(ring + height * shift)
    return loft(sections)


def frustum(low: Sequence[float], high: Sequence[float], heights: tuple[float, float], up: str) -> FloatArray:
    """Return a solid between two rectangles about the `up` axis.

    `low` and `high` are their half sizes along the two other axes; (0, 0) makes a pyramid, (a, 0) a hipped roof.
    """
    shift = np.eye(3)["xyz".index(up)]
    rings = []
    for (a, b), height in zip((low, high), heights, strict=True):
        ring = np.zeros((4, 3))
        ring[:, _PLANES["y"] if up == "y" else _PLANES["z"]] = [(-a, -b), (a, -b), (a, b), (-a, b)]
        rings.append(ring + height * shift)
    return loft(rings)


def circle(radius: float, segments: int) -> list[Point]:
    """Return the corners of a regular polygon about the origin, a side at the bottom."""
    angles = (np.arange(segments) + 0.5) * (2 * np.pi / segments) - np.pi / 2
    return [(float(radius * np.cos(a)), float(radius * np.sin(a))) for a in angles]


def arch(centre: Point, radius: float, base: float, segments: int = 12) -> list[Point]:
    """Return points of a circular arch over the level `base`, from its smaller to its greater first coordinate."""
    a, b = centre
    reach = np.arccos(np.clip((base - b) / radius, -1, 1))
    angles = np.linspace(-reach, reach, segments + 1)
    return [(float(a + radius * np.sin(t)), float(b + radius * np.cos(t))) for t in angles]


def _band(lower: FloatArray, upper: FloatArray) -> FloatArray:
    """Triangles between two rings of the same length."""
    lower_next, upper_next = np.roll(lower, -1, axis=0), np.roll(upper, -1, axis=0)
    first = np.stack([lower, lower_next, upper_next], axis=1)
    second = np.stack([lower, upper_next, upper], axis=1)
    return np.stack([first, second], axis=1).reshape(-1, 3, 3)


def _cap(ring: FloatArray) -> FloatArray:
    """Triangles that fill a planar ring, turning the way the ring turns."""
    normal = np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)
    if np.linalg.norm(normal) < 2 * _THINNEST:
        return np.zeros((0, 3, 3))
    drop = int(np.argmax(np.abs(normal).round(9)))
    return ring[ear_clipped(np.delete(ring, drop, axis=1))]

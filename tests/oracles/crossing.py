"""Exact test whether planar polygons with holes cross in space; shares no code with the simulation.

Two polygons cross where the line of their planes runs through the inside of both at one place. Their depth there
is how far inside both the place is: the paper that would have to be trimmed. Polygons that only touch (edge on
edge, edge on face) have depth 0, and so do polygons in parallel planes.

Two polygons that are hinged together may pierce a third with their fold alone: each only touches it, from one
side, and together they are on both sides of it. That counts as well.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from shapely import LineString, Point, Polygon

from popsim.design import Design, Patch

IN_PLANE = 1e-5
"""mm; a fold nearer than this to a plane lies in it."""

SAMPLES = 17
"""Places along a crossing at which its depth is measured, ends included."""


@dataclass(frozen=True, eq=False)
class Face:
    """A planar polygon with flat coordinates of its own: point = origin + flat @ axes."""

    origin: np.ndarray
    axes: np.ndarray
    polygon: Polygon

    @staticmethod
    def of(patch: Patch) -> "Face":
        ring = np.array(patch.outline)
        _, _, axes = np.linalg.svd(ring - ring.mean(axis=0))
        origin, axes = ring.mean(axis=0), axes[:2]
        flat = [(np.array(part) - origin) @ axes.T for part in (patch.outline, *patch.holes)]
        return Face(origin, axes, Polygon(flat[0], flat[1:]))

    def moved(self, pose: np.ndarray) -> "Face":
        turn = pose[:3, :3]
        return Face(turn @ self.origin + pose[:3, 3], self.axes @ turn.T, self.polygon)

    @cached_property
    def normal(self) -> np.ndarray:
        return np.cross(*self.axes)

    @cached_property
    def bounds(self) -> np.ndarray:
        corners = np.array(self.polygon.exterior.coords) @ self.axes + self.origin
        return np.array([corners.min(axis=0), corners.max(axis=0)])

    def inside(self, start: np.ndarray, direction: np.ndarray, reach: float) -> list[tuple[float, float]]:
        """Intervals of the line start + t direction, |t| <= reach, that lie in the polygon."""
        flat = [(start + t * direction - self.origin) @ self.axes.T for t in (-reach, reach)]
        found = self.polygon.intersection(LineString(flat))
        pieces = [piece for piece in getattr(found, "geoms", [found]) if isinstance(piece, LineString)]
        begin = np.array(flat[0])
        return sorted(
            tuple(sorted(float(np.linalg.norm(np.array(end) - begin)) - reach for end in piece.coords))
            for piece in pieces
            if not piece.is_empty
        )

    def side_of(self, other: "Face") -> int:
        """1 or -1 where another face lies wholly on one side of the plane, 0 where it does not leave it."""
        corners = np.array(other.polygon.exterior.coords) @ other.axes + other.origin
        heights = (corners - self.origin) @ self.normal
        if heights.max() > -heights.min():
            return int(heights.max() > 100 * IN_PLANE and heights.min() > -IN_PLANE)
        return -int(heights.min() < -100 * IN_PLANE and heights.max() < IN_PLANE)

    def depth_at(self, point: np.ndarray) -> float:
        """Distance of a point of the polygon from its nearest edge or hole, mm."""
        return float(self.polygon.boundary.distance(Point((point - self.origin) @ self.axes.T)))


def crossing_depth(first: Face, second: Face) -> float:
    """How deep two polygons cross, mm; 0 where they are apart, touch or are parallel."""
    direction = np.cross(first.normal, second.normal)
    sine = float(np.linalg.norm(direction))
    if sine < 1e-6:
        return 0.0
    direction /= sine
    planes = np.array([first.normal, second.normal, direction])
    middle = (first.origin + second.origin) / 2
    start = np.linalg.solve(
        planes, [first.normal @ first.origin, second.normal @ second.origin, direction @ middle]
    )
    reach = float(max(np.ptp(np.stack([first.bounds, second.bounds]).reshape(-1, 3), axis=0).sum(), 1.0)) * 2
    deepest = 0.0
    for a0, a1 in first.inside(start, direction, reach):
        for b0, b1 in second.inside(start, direction, reach):
            for t in np.linspace(max(a0, b0), min(a1, b1), SAMPLES) if min(a1, b1) > max(a0, b0) else ():
                point = start + t * direction
                deepest = max(deepest, min(first.depth_at(point), second.depth_at(point)))
    return deepest


def piercing_depth(axis: np.ndarray, wings: tuple[Face, Face], third: Face) -> float:
    """How deep the fold `axis` (2, 3) of two polygons lies in a third that they are on both sides of, mm."""
    if np.abs((axis - third.origin) @ third.normal).max() > IN_PLANE:
        return 0.0
    sides = [third.side_of(wing) for wing in wings]
    if sides[0] * sides[1] >= 0:
        return 0.0
    points = np.linspace(*axis, SAMPLES)
    flat = [(point - third.origin) @ third.axes.T for point in points]
    return max(
        (third.depth_at(p) for p, q in zip(points, flat, strict=True) if third.polygon.covers(Point(q))),
        default=0.0,
    )


@dataclass(frozen=True)
class Crossing:
    """Two patches that cross at a fold angle (radians), and how deep, mm."""

    patches: tuple[str, str]
    theta: float
    depth: float


def crossings(
    design: Design, poses: Mapping[str, np.ndarray], theta: Iterable[float], least: float = 0.01
) -> Iterator[Crossing]:
    """All crossings deeper than `least` mm of patches that share no hinge, and of folds with a third patch.

    `poses` holds a motion per angle, (n, 4, 4), by patch id.
    """
    faces = {patch.id: Face.of(patch) for patch in design.patches if patch.id in poses}
    hinged = {frozenset(hinge.patches) for hinge in design.hinges}
    for index, angle in enumerate(theta):
        now = {name: face.moved(poses[name][index]) for name, face in faces.items()}
        for first, second in _near(now):
            depth = 0.0 if frozenset((first, second)) in hinged else crossing_depth(now[first], now[second])
            if depth > least:
                yield Crossing((first, second), float(angle), depth)
        yield from _piercings(design, {name: motion[index] for name, motion in poses.items()}, now, angle, least)


def _piercings(
    design: Design, poses: Mapping[str, np.ndarray], faces: Mapping[str, Face], angle: float, least: float
) -> Iterator[Crossing]:
    """Folds of two patches inside a third that neither is hinged to along that line."""
    for hinge in design.hinges:
        left, right = hinge.patches
        if not (left in faces and right in faces):
            continue
        axis = np.array(hinge.axis) @ poses[left][:3, :3].T + poses[left][:3, 3]
        for name, third in faces.items():
            if (
                name in hinge.patches
                or (axis.min(axis=0) > third.bounds[1]).any()
                or (axis.max(axis=0) < third.bounds[0]).any()
            ):
                continue
            depth = piercing_depth(axis, (faces[left], faces[right]), third)
            if depth > least:
                yield Crossing((f"{left}+{right}", name), float(angle), depth)


def _near(faces: Mapping[str, Face]) -> list[tuple[str, str]]:
    """Pairs of faces whose bounding boxes meet."""
    names, bounds = list(faces), np.array([face.bounds for face in faces.values()])
    apart = (bounds[:, None, 0] > bounds[None, :, 1]).any(axis=-1)
    return [(names[i], names[j]) for i, j in np.argwhere(np.triu(~(apart | apart.T), 1))]

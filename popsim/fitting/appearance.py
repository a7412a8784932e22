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

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.surface import Material, Surface
from popsim.mechanisms import Mechanism, Plate

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

PIXELS = 48
"""Pixels along the diagonal of the model, in each view."""

MASK = 160
"""Pixels along the longest side in the silhouettes that cut plates."""

DEEP = 0.04
"""Share of the diagonal by which depths may differ and still count as the same surface."""

NEAR = 0.06
"""Share of the diagonal within which the model lies near a plate."""

LIFT = np.sin(np.radians(30.0))
"""Height of the views over the corners."""


def view_directions() -> FloatArray:
    """Directions to the eye: front, back, sides, top, and four over the corners, shape (9, 3)."""
    level = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    flat = np.cos(np.radians(30.0)) / np.sqrt(2)
    corners = [(i * flat, j * flat, LIFT) for i in (1, -1) for j in (1, -1)]
    return np.array(level + corners, float)


@dataclass(frozen=True)
class Likeness:
    """Shares of what either shows that both show (silhouette), and at the same depth (relief), 0..1."""

    silhouette: float
    relief: float

    @property
    def overall(self) -> float:
        """The mean of both."""
        return (self.silhouette + self.relief) / 2


class Appearance:
    """A model seen from all sides, to hold abstractions against."""

    def __init__(self, scene: "RayScene", bounds: FloatArray) -> None:
        self.scene, self.bounds = scene, bounds
        self.centre = bounds.mean(axis=0)
        self.diagonal = float(np.linalg.norm(bounds[1] - bounds[0]))

    def likeness(self, mechanisms: Sequence[Mechanism]) -> Likeness:
        """Compare mechanisms with the model."""
        plates = [plate for mechanism in mechanisms for plate in mechanism.plates()]
        depth = self._cut_depth(plates)
        model, shown = self._model_depth, np.isfinite(depth)
        seen = np.isfinite(model)
        both, union = shown & seen, (shown | seen).sum(axis=1)
        with np.errstate(invalid="ignore"):
            close = both & (np.abs(depth - model) <= DEEP * self.diagonal)
        return Likeness(float((both.sum(axis=1) / union).mean()), float((close.sum(axis=1) / union).mean()))

    @cached_property
    def _rays(self) -> tuple[FloatArray, FloatArray]:
        """Origins and directions of all rays, view after view, shape (9 p, 3)."""
        steps = (np.arange(PIXELS) + 0.5) / PIXELS - 0.5
        across, up = np.meshgrid(steps, steps)
        origins, directions = [], []
        for eye in view_directions():
            upright = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
            right = np.cross(upright, eye)
            right /= np.linalg.norm(right)
            rise = np.cross(eye, right)
            plane = across.reshape(-1, 1) * right + up.reshape(-1, 1) * rise
            origins.append(self.centre + self.diagonal * (plane + eye))
            directions.append(np.broadcast_to(-eye, plane.shape))
        return np.concatenate(origins), np.concatenate(directions)

    @cached_property
    def _model_depth(self) -> FloatArray:
        """Depth of the model per view and pixel, inf where empty, shape (9, p)."""
        return self.scene.hit(*self._rays).distance.reshape(len(view_directions()), -1)

    @cached_property
    def _fronts(self) -> tuple[float, list[list[FloatArray]]]:
        """Pixel, and the model seen along each axis from each side: how far out it reaches, -inf where empty.

        Lists by axis, then by side (from the high end first); each map is indexed by the cells of the other axes.
        """
        low, size = self.bounds[0], self.bounds[1] - self.bounds[0]
        pixel = float(size.max()) / MASK
        fronts = []
        for axis in range(3):
            first, second = (k for k in range(3) if k != axis)
            grid = [np.arange(int(np.ceil(size[k] / pixel)) + 1) for k in (first, second)]
            a, b = np.meshgrid(*grid, indexing="ij")
            origins = np.empty((a.size, 3))
            origins[:, first] = low[first] + (a.ravel() + 0.5) * pixel
            origins[:, second] = low[second] + (b.ravel() + 0.5) * pixel
            sides = []
            for sign in (1.0, -1.0):
                start = sign * (np.abs(self.bounds[:, axis]).max() + self.diagonal)
                origins[:, axis] = start
                direction = np.zeros((1, 3))
                direction[0, axis] = -sign
                sides.append((sign * start - self.scene.hit(origins, direction).distance).reshape(a.shape))
            fronts.append(sides)
        return pixel, fronts

    def _cut_depth(self, plates: Sequence[Plate]) -> FloatArray:
        """Depth of the plates as contours would leave them, per view and pixel, shape (9, p)."""
        from popsim.rendering.ray_scene import RayScene

        parts = [_Part(plate, outline, deep) for plate in plates for outline, deep in self._areas(plate)]
        fans = [_triangles(part.outline) for part in parts]
        owner = np.repeat(np.arange(len(parts)), [len(fan) for fan in fans])
        triangles = np.concatenate(fans)
        count = len(triangles)
        white = (Material(np.ones(4)),)
        scene = RayScene(Surface(triangles, np.zeros((count, 3, 2)), np.zeros(count, np.int64), white))
        origins, directions = self._rays
        found = scene.crossings(origins, directions)
        points = origins[found.ray] + found.distance[:, None] * directions[found.ray]
        kept = self._covered(points, owner[found.face], parts)
        depth = np.full(len(origins), np.inf)
        np.minimum.at(depth, found.ray[kept], found.distance[kept])
        return depth.reshape(len(view_directions()), -1)

    def _areas(self, plate: Plate) -> list[tuple[FloatArray, float]]:
        """Outlines of a plate and how deep behind each the model still shows on it."""
        areas = [(plate.outline, plate.behind)]
        if plate.principal and plate.room is not None and len(plate.room) > 2:
            areas.append((plate.room, NEAR * self.diagonal))
        return areas

    def _covered(self, points: FloatArray, owner: IntArray, parts: Sequence["_Part"]) -> BoolArray:
        """Which points of plates show the model."""
        pixel, fronts = self._fronts
        cells = np.floor((points - self.bounds[0]) / pixel).astype(np.int64)
        axis = np.array([part.axis for part in parts])[owner]
        sign = np.array([part.sign for part in parts])[owner]
        deep = np.array([part.deep for part in parts])[owner]
        reach = np.full(len(points), -np.inf)
        for along in range(3):
            for side, facing in enumerate((1, -1)):
                mine = (axis == along) & (sign == facing)
                front = fronts[along][side]
                first, second = (cells[mine, k] for k in range(3) if k != along)
                inside = (first >= 0) & (first < front.shape[0]) & (second >= 0) & (second < front.shape[1])
                found = np.full(len(first), -np.inf)
                found[inside] = front[first[inside], second[inside]]
                reach[mine] = found
        at = sign * points[np.arange(len(points)), axis]
        return np.asarray(np.isfinite(reach) & (reach >= at - deep))


class _Part:
    """An outline of a plate, the axis it faces most, and how deep behind it the model shows."""

    def __init__(self, plate: Plate, outline: FloatArray, deep: float) -> None:
        self.outline, self.deep = outline, deep
        self.axis = int(np.abs(plate.outward).argmax())
        self.sign = 1 if plate.outward[self.axis] > 0 else -1


def _triangles(outline: FloatArray) -> FloatArray:
    """A simple planar outline (n, 3) as triangles (m, 3, 3)."""
    if len(outline) <= 4:
        return np.array([[outline[0], outline[k], outline[k + 1]] for k in range(1, len(outline) - 1)])
    from mapbox_earcut import triangulate_float64

    from popsim.geometry.plane import Plane

    flat = Plane.through(outline).flat(outline)
    faces = np.asarray(triangulate_float64(flat, np.array([len(flat)], dtype=np.uint32)), dtype=np.int64)
    return outline[faces.reshape(-1, 3)]

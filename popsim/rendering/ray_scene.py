"""Rays against a surface: found by Embree, then made exact in double precision."""

from collections.abc import Callable, Iterator
from copy import copy
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.surface import Surface
from popsim.geometry.weld import corner_numbers
from popsim.rendering.face_planes import FacePlanes
from popsim.rendering.paint import Paint
from popsim.rendering.parallel import map_chunks
from popsim.rendering.smooth_normals import smooth_normals
from popsim.rendering.twins import TwinFaces

RADIUS = 100.0  # the surface is scaled to this for Embree, which works in float32
TOLERANCE = 1e-5  # times the half diagonal of the bounds: surfaces nearer to each other count as one
SMALLEST = 1e-12  # half diagonal of a surface that is one point
MAX_LAYERS = 64  # holed faces that one ray passes; nothing is seen behind so many


class Hits(NamedTuple):
    """The first hit of each of `n` rays.

    `distance` (n,) is infinite, `face` (n,) is -1 and `bary` (n, 3) zero where nothing was hit.
    """

    distance: FloatArray
    face: IntArray
    bary: FloatArray


class Crossings(NamedTuple):
    """All hits of all rays, sorted by ray, then by distance; each array of shape (k,)."""

    ray: IntArray
    distance: FloatArray
    face: IntArray


class _Layer(NamedTuple):
    ray: IntArray
    distance: FloatArray
    face: IntArray
    bary: FloatArray
    stops: BoolArray


class RayScene:
    """A surface prepared for rays; build it once, trace it often.

    Two-sided: a ray meets a face from either side. Faces that coincide count as one: the one that turns
    its front to the ray is hit.

    Attributes
    ----------
    surface:
        What was prepared.
    paint:
        Its unlit colours.
    size:
        Half the diagonal of the bounds, in units of the surface.
    tolerance:
        Length below which surfaces are not told apart.

    Raises
    ------
    GeometryError
        The surface has no triangles.
    """

    def __init__(self, surface: Surface) -> None:
        if not len(surface.triangles):
            raise GeometryError("a surface without triangles cannot be seen; give at least one")
        self.surface = surface
        self.paint = Paint(surface)
        low, high = surface.bounds
        self._centre = (low + high) / 2
        self.size: float = max(float(np.linalg.norm(high - low)) / 2, SMALLEST)
        self.tolerance = TOLERANCE * self.size
        self._planes = FacePlanes.of(surface.triangles - self._centre)
        self._twins = TwinFaces.of(corner_numbers(surface.triangles), self.normals, self.paint.holed)
        self._embree, self._mesh = self._build()

    @property
    def normals(self) -> FloatArray:
        """Unit normals of the faces by the right-hand rule, shape (m, 3); zero for degenerate faces."""
        return self._planes.normals

    def _build(self) -> tuple[Any, Any]:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        scene = EmbreeScene(robust=True)
        corners = self._planes.corners[self._twins.front] * (RADIUS / self.size)
        mesh = TriangleMesh(scene, np.ascontiguousarray(corners, dtype=np.float32))
        nowhere = np.zeros((1, 3), dtype=np.float32)
        scene.run(nowhere, nowhere + 1)  # builds the tree now, before threads share it
        return scene, mesh

    def opaque(self) -> "RayScene":
        """Return the shape alone, white and without holes, for the price of its colours."""
        return self._sharing(self.surface.bare())

    def scaled(self, factor: float) -> "RayScene":
        """Return the surface `factor` times as large about the origin; what rays need is not built again."""
        grow = np.diag([factor, factor, factor, 1.0])
        other = self._sharing(self.surface.transformed(grow))
        other._centre = self._centre * factor
        other.size, other.tolerance = self.size * factor, self.tolerance * factor
        other._planes = self._planes.scaled(factor)
        return other

    def _sharing(self, surface: Surface) -> "RayScene":
        """Return a scene of another surface with the same faces, up to scale."""
        other = copy(self)
        other.surface, other.paint = surface, Paint(surface)
        return other

    @cached_property
    def corner_normals(self) -> npt.NDArray[np.float32]:
        """Normals for shading, smooth over flat joints, shape (m, 3, 3)."""
        return smooth_normals(self.surface.triangles, self.normals)

    def shading_normals(self, face: IntArray, bary: FloatArray, directions: FloatArray) -> npt.NDArray[np.float32]:
        """Return unit normals for shading, shape (k, 3), on the side that rays along `directions` meet."""
        normal = np.einsum("kc,kcd->kd", bary.astype(np.float32), self.corner_normals[face])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.float32(1e-6))
        away = np.einsum("kd,kd->k", self.normals[face], np.broadcast_to(directions, normal.shape)) > 0
        result: npt.NDArray[np.float32] = np.where(away[:, None], -normal, normal)
        return result

    def hit(
        self,
        origins: FloatArray,
        directions: FloatArray,
        *,
        near: FloatArray | float = 0.0,
        far: FloatArray | float = np.inf,
        through_holes: bool = True,
    ) -> Hits:
        """Return the first face that each ray meets.

        Parameters
        ----------
        origins:
            Shape (n, 3).
        directions:
            Of any length but 0, shape (n, 3) or (1, 3) for parallel rays.
        near, far:
            Only what lies between these distances from the origins is met (give or take `tolerance`); numbers,
            or one for each ray, shape (n,).
        through_holes:
            Rays pass through texels and colours of alpha < 0.5.
        """
        origins, directions = _rays(origins, directions)
        starts, stops = (np.broadcast_to(ends, len(origins)) for ends in (near, far))
        solid = self.paint.solid if through_holes else _everything

        def trace(part: slice) -> Hits:
            along = directions if len(directions) == 1 else directions[part]
            result = _no_hits(len(origins[part]))
            for layer in self._layers(origins[part], along, starts[part], stops[part], solid):
                at = layer.ray[layer.stops]
                result.distance[at] = layer.distance[layer.stops]
                result.face[at] = layer.face[layer.stops]
                result.bary[at] = layer.bary[layer.stops]
            return result

        parts = map_chunks(trace, len(origins))
        return Hits(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def crossings(self, origins: FloatArray, directions: FloatArray, *, far: float = np.inf) -> Crossings:
        """Return all faces that the rays meet, holes included; at most 64 per ray.

        Crossings nearer to each other than `tolerance` (as on an edge between two faces) count once.
        """
        origins, directions = _rays(origins, directions)
        start, stop = (np.broadcast_to(ends, len(origins)) for ends in (0.0, far))

        def trace(part: slice) -> Crossings:
            along = directions if len(directions) == 1 else directions[part]
            layers = list(self._layers(origins[part], along, start[part], stop[part], _nothing))
            ray = np.concatenate([layer.ray for layer in layers] or [np.zeros(0, dtype=np.int64)])
            distance = np.concatenate([layer.distance for layer in layers] or [np.zeros(0)])
            face = np.concatenate([layer.face for layer in layers] or [np.zeros(0, dtype=np.int64)])
            order = np.argsort(ray, kind="stable")  # the layers come nearest first
            return Crossings(ray[order] + part.start, distance[order], face[order])

        parts = map_chunks(trace, len(origins))
        return Crossings(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def thickness(self, origins: FloatArray, directions: FloatArray) -> FloatArray:
        """Return the length of each ray inside the surface, shape (n,).

        Rays that start outside enter at odd and leave at even crossings; a last crossing without a
        partner (the surface is open there) adds nothing.
        """
        crossings = self.crossings(origins, directions)
        count = np.bincount(crossings.ray, minlength=len(origins))
        first = np.cumsum(count) - count
        rank = np.arange(len(crossings.ray)) - first[crossings.ray]
        paired = rank < (count - count % 2)[crossings.ray]
        signed = np.where(rank % 2 == 0, -crossings.distance, crossings.distance)
        inside = np.bincount(crossings.ray[paired], signed[paired], len(origins))
        return inside.astype(np.float64)  # whole numbers where no ray hit anything

    def occluded(self, origins: FloatArray, directions: FloatArray, *, far: float = np.inf) -> BoolArray:
        """Return which rays meet anything before `far`, shape (n,); holes let them through."""
        origins, directions = _rays(origins, directions)

        def trace(part: slice) -> BoolArray:
            along = directions if len(directions) == 1 else directions[part]
            start = origins[part] + along * (2 * self.tolerance)
            result: BoolArray = self._run(start, along, np.full(len(start), far), query="OCCLUDED") >= 0
            return result

        result = np.concatenate(map_chunks(trace, len(origins)))
        if self.paint.holed.any():
            at = np.flatnonzero(result)
            along = directions if len(directions) == 1 else directions[at]
            result[at] = self.hit(origins[at], along, near=2 * self.tolerance, far=far).face >= 0
        return result

    def _run(self, origins: FloatArray, directions: FloatArray, far: FloatArray, **options: Any) -> Any:
        scale = RADIUS / self.size
        start = ((origins - self._centre) * scale).astype(np.float32)
        reach = np.minimum(far * scale, 1e30).astype(np.float32)
        return self._embree.run(start, directions.astype(np.float32), dists=reach, **options)

    def _layers(
        self,
        origins: FloatArray,
        directions: FloatArray,
        near: FloatArray,
        far: FloatArray,
        stops: Callable[[IntArray, FloatArray], BoolArray],
    ) -> Iterator[_Layer]:
        """Yield hit after hit of the rays that nothing has stopped yet."""
        live = np.arange(len(origins))
        start, stop = near - self.tolerance, far + self.tolerance
        for _ in range(MAX_LAYERS):
            along = directions if len(directions) == 1 else directions[live]
            reach = np.maximum(stop[live] - start, 0.0)
            found = self._run(origins[live] + along * start[:, None], along, reach, output=True)
            met = found["primID"] >= 0
            rough = start[met] + found["tfar"][met].astype(np.float64) * (self.size / RADIUS)
            live, along = live[met], along if len(along) == 1 else along[met]
            face = self._twins.seen(found["primID"][met], self.normals, along)
            distance, bary = self._planes.meet(face, origins[live] - self._centre, along, rough)
            layer = _Layer(live, distance, face, bary, stops(face, bary))
            yield layer
            live = live[~layer.stops]
            if not len(live):
                return
            start = np.maximum(distance, rough)[~layer.stops] + self.tolerance


def _rays(origins: FloatArray, directions: FloatArray) -> tuple[FloatArray, FloatArray]:
    origins, directions = np.asarray(origins, dtype=np.float64), np.asarray(directions, dtype=np.float64)
    if origins.ndim != 2 or origins.shape[1] != 3 or directions.shape not in (origins.shape, (1, 3)):
        raise GeometryError(
            f"rays need origins (n, 3) and directions (n, 3) or (1, 3), not {origins.shape} and {directions.shape}"
        )
    length = np.linalg.norm(directions, axis=1, keepdims=True)
    if not (length > 0).all():
        raise GeometryError("a ray has the direction 0 0 0; give every ray a direction")
    return origins, directions / length


def _no_hits(count: int) -> Hits:
    return Hits(np.full(count, np.inf), np.full(count, -1, dtype=np.int64), np.zeros((count, 3)))


def _everything(face: IntArray, bary: FloatArray) -> BoolArray:
    return np.ones(len(face), dtype=bool)


def _nothing(face: IntArray, bary: FloatArray) -> BoolArray:
    return np.zeros(len(face), dtype=bool)

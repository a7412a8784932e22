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
FARTHEST = 1e30  # what Embree takes for infinitely far
MAX_LAYERS = 64  # holed faces that one ray passes; nothing is seen behind so many


class Hits(NamedTuple):
    """The first hit of each of `n` rays.

    `distance` (n,) is infinite, `face` (n,) is -1 and `bary` (n, 3) zero where nothing was hit; `bary` has no rows
    where it was not asked for.
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
    """A hit of each of some rays: which rays, how far, which face, where on it, and which of them it stops."""

    ray: IntArray
    distance: FloatArray
    face: IntArray
    bary: FloatArray | None
    stops: BoolArray | None


class _Rays(NamedTuple):
    """Rays from `origins` (n, 3) along unit `directions`, (n, 3) or (1, 3); two distances each, (n,) or (1,)."""

    origins: FloatArray
    directions: FloatArray
    near: FloatArray
    far: FloatArray

    def some(self, which: slice | IntArray) -> "_Rays":
        """Those with some numbers."""
        directions, near, far = (
            values if len(values) == 1 else values[which] for values in (self.directions, self.near, self.far)
        )
        return _Rays(self.origins[which], directions, near, far)


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
        self._planes = FacePlanes.of(surface, self._centre)
        self._numbers = corner_numbers(surface.triangles).astype(np.int32)
        self._twins = TwinFaces.of(self._numbers, self.normals, self.paint.holed)
        self._embree, self._mesh = self._build()

    @property
    def normals(self) -> FloatArray:
        """Unit normals of the faces by the right-hand rule, shape (m, 3); zero for degenerate faces."""
        return self._planes.normals

    def _build(self) -> tuple[Any, Any]:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        scene = EmbreeScene(robust=True)
        points = np.empty((int(self._numbers.max()) + 1, 3))
        points[self._numbers.ravel()] = self.surface.triangles.reshape(-1, 3)
        points -= self._centre
        points *= RADIUS / self.size
        mesh = TriangleMesh(scene, points.astype(np.float32), self._numbers[self._twins.front])
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
        other._planes = self._planes.scaled(factor, other.surface.triangles)
        return other

    def _sharing(self, surface: Surface) -> "RayScene":
        """Return a scene of another surface with the same faces, up to scale."""
        other = copy(self)
        other.surface, other.paint = surface, Paint(surface)
        return other

    @cached_property
    def corner_normals(self) -> npt.NDArray[np.float32]:
        """Normals for shading, smooth over flat joints, shape (m, 3, 3)."""
        return smooth_normals(self.surface, self._numbers)

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
        bary: bool = False,
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
        bary:
            Whether to tell where on its face each ray ends.
        """
        rays = _rays(origins, directions, near, far)
        holed = through_holes and self.paint.has_holes
        stops = self.paint.solid if holed else None

        def trace(part: slice) -> Hits:
            here = rays.some(part)
            count = len(here.origins)
            distance, face = np.full(count, np.inf), np.full(count, -1, dtype=np.int64)
            places = np.zeros((count if bary else 0, 3))
            for layer in self._layers(here, stops, bary=bary or holed):
                at = layer.ray if layer.stops is None else layer.ray[layer.stops]
                kept = slice(None) if layer.stops is None else layer.stops
                distance[at], face[at] = layer.distance[kept], layer.face[kept]
                if bary and layer.bary is not None:
                    places[at] = layer.bary[kept]
            return Hits(distance, face, places)

        parts = map_chunks(trace, len(rays.origins))
        return Hits(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def crossings(self, origins: FloatArray, directions: FloatArray, *, far: float = np.inf) -> Crossings:
        """Return all faces that the rays meet, holes included; at most 64 per ray.

        Crossings nearer to each other than `tolerance` (as on an edge between two faces) count once.
        """
        rays = _rays(origins, directions, 0.0, far)

        def trace(part: slice) -> Crossings:
            layers = list(self._layers(rays.some(part), _nothing))
            ray = np.concatenate([layer.ray for layer in layers] or [np.zeros(0, dtype=np.int64)])
            distance = np.concatenate([layer.distance for layer in layers] or [np.zeros(0)])
            face = np.concatenate([layer.face for layer in layers] or [np.zeros(0, dtype=np.int64)])
            order = np.argsort(ray, kind="stable")  # the layers come nearest first
            return Crossings(ray[order] + part.start, distance[order], face[order])

        parts = map_chunks(trace, len(rays.origins))
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
        """Return which rays meet anything before `far`, shape (n,); holes let them through.

        What is nearer than twice the tolerance is passed over: rays may start on the surface.
        """
        return self.meets(origins, directions, near=3 * self.tolerance, far=far - self.tolerance)

    def meets(
        self,
        origins: FloatArray,
        directions: FloatArray,
        *,
        near: FloatArray | float = 0.0,
        far: FloatArray | float = np.inf,
    ) -> BoolArray:
        """Return which rays meet anything, shape (n,): where :meth:`hit` finds a face, for a third of the time."""
        rays = _rays(origins, directions, near, far)

        def trace(part: slice) -> BoolArray:
            here = rays.some(part)
            start, reach = here.near - self.tolerance, here.far - here.near + 2 * self.tolerance
            found: BoolArray = self._run(here.origins, here.directions, start, reach, query="OCCLUDED") >= 0
            return found

        result = np.concatenate(map_chunks(trace, len(rays.origins)))
        if self.paint.has_holes:
            at = np.flatnonzero(result)
            some = rays.some(at)
            result[at] = self.hit(some.origins, some.directions, near=some.near, far=some.far).face >= 0
        return result

    def _run(
        self, origins: FloatArray, directions: FloatArray, start: FloatArray, reach: FloatArray, **options: Any
    ) -> Any:
        """What Embree finds along rays, from a distance on, no further than a reach from there."""
        scale = RADIUS / self.size
        points = origins + (directions * start[:, None] - self._centre)
        points *= scale
        far = np.empty(len(points), dtype=np.float32)
        far[:] = np.clip(reach * scale, 0.0, FARTHEST)
        return self._embree.run(points.astype(np.float32), directions.astype(np.float32), dists=far, **options)

    def _layers(
        self, rays: _Rays, stops: Callable[[IntArray, FloatArray], BoolArray] | None, *, bary: bool = True
    ) -> Iterator[_Layer]:
        """Yield hit after hit of the rays that nothing has stopped yet; `stops` None: every hit does."""
        start, stop = rays.near - self.tolerance, rays.far + self.tolerance
        live: IntArray | None = None
        for _ in range(MAX_LAYERS):
            found = self._run(rays.origins, rays.directions, start, stop - start, output=True)
            met = np.flatnonzero(found["primID"] >= 0)
            rays, start, stop = (
                rays.some(met),
                start if len(start) == 1 else start[met],
                stop if len(stop) == 1 else stop[met],
            )
            live = met if live is None else live[met]
            rough = start + found["tfar"][met].astype(np.float64) * (self.size / RADIUS)
            face = self._twins.seen(found["primID"][met], self.normals, rays.directions)
            relative = rays.origins - self._centre
            distance = self._planes.distance(face, relative, rays.directions, rough)
            places = self._planes.bary(face, relative + distance[:, None] * rays.directions) if bary else None
            if stops is None or places is None:
                yield _Layer(live, distance, face, places, None)
                return
            stopped = stops(face, places)
            yield _Layer(live, distance, face, places, stopped)
            on = np.flatnonzero(~stopped)
            if not len(on):
                return
            rays, live = rays.some(on), live[on]
            start = np.maximum(distance, rough)[on] + self.tolerance
            stop = stop if len(stop) == 1 else stop[on]


def _rays(origins: FloatArray, directions: FloatArray, near: FloatArray | float, far: FloatArray | float) -> _Rays:
    origins, directions = np.asarray(origins, dtype=np.float64), np.asarray(directions, dtype=np.float64)
    if origins.ndim != 2 or origins.shape[1] != 3 or directions.shape not in (origins.shape, (1, 3)):
        raise GeometryError(
            f"rays need origins (n, 3) and directions (n, 3) or (1, 3), not {origins.shape} and {directions.shape}"
        )
    length = np.linalg.norm(directions, axis=1, keepdims=True)
    if not (length > 0).all():
        raise GeometryError("a ray has the direction 0 0 0; give every ray a direction")
    start, stop = (np.atleast_1d(np.asarray(end, dtype=np.float64)) for end in (near, far))
    return _Rays(origins, directions / length, start, stop)


def _nothing(face: IntArray, bary: FloatArray) -> BoolArray:
    return np.zeros(len(face), dtype=bool)

"""Exact intersections of rays with given faces, in double precision."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray, cross
from popsim.geometry.extent import CHUNK
from popsim.geometry.surface import Surface

GRAZING = 1e-2  # faces that a ray meets at a smaller sine are bounded by their corners


@dataclass(frozen=True, eq=False)
class FacePlanes:
    """The planes of `m` triangles and the barycentric coordinates in them, as linear functions of space.

    Attributes
    ----------
    triangles:
        Shape (m, 3, 3).
    centre:
        Where all of the following, and points, are counted from, shape (3,).
    normals:
        Unit normals by the right-hand rule, shape (m, 3); zero for degenerate faces.
    offset:
        The plane of a face is normal . p = offset, shape (m,).
    gradient, constant:
        The coordinates of corners 1 and 2 at p are gradient . p + constant; shapes (m, 2, 3), (m, 2).
    """

    triangles: FloatArray
    centre: FloatArray
    normals: FloatArray
    offset: FloatArray
    gradient: FloatArray
    constant: FloatArray

    @classmethod
    def of(cls, surface: Surface, centre: FloatArray) -> "FacePlanes":
        """Return the planes of the triangles of a surface, counted from a point (3,)."""
        count = len(surface.triangles)
        offset, gradient, constant = np.empty(count), np.empty((count, 2, 3)), np.empty((count, 2))
        for start in range(0, count, CHUNK):
            part = slice(start, start + CHUNK)
            normals = surface.normals[part]
            corners = surface.triangles[part] - centre
            a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            across = np.stack([cross(b, normals), cross(normals, a)], axis=1)
            area = 2 * surface.areas[part, None, None]
            gradient[part] = np.divide(across, area, out=np.zeros_like(across), where=area > 0)
            constant[part] = -np.einsum("mcd,md->mc", gradient[part], corners[:, 0])
            offset[part] = np.einsum("md,md->m", normals, corners[:, 0])
        return cls(surface.triangles, centre, surface.normals, offset, gradient, constant)

    def scaled(self, factor: float, triangles: FloatArray) -> "FacePlanes":
        """Return the planes of the triangles `factor` times as large about the origin."""
        gradient = self.gradient / factor
        return FacePlanes(
            triangles, self.centre * factor, self.normals, self.offset * factor, gradient, self.constant
        )

    def distance(
        self, face: IntArray, origins: FloatArray, directions: FloatArray, rough: FloatArray
    ) -> FloatArray:
        """Return how far from their origins rays meet faces, shape (k,).

        Parameters
        ----------
        face:
            The faces that the rays are known to hit, shape (k,).
        origins, directions:
            Shape (k, 3), from the centre; unit directions, or one for all, shape (1, 3).
        rough:
            Distances good to single precision, shape (k,); used where a ray runs along its face.
        """
        normal = self.normals[face]
        sine = normal @ directions[0] if len(directions) == 1 else np.einsum("kd,kd->k", normal, directions)
        height = self.offset[face] - np.einsum("kd,kd->k", normal, origins)
        clear = np.abs(sine) > GRAZING
        distance = np.divide(height, sine, out=rough.copy(), where=clear)
        grazing = np.flatnonzero(~clear)
        if len(grazing):
            along = directions if len(directions) == 1 else directions[grazing]
            corners = self.triangles[face[grazing]] - self.centre - origins[grazing, None]
            reach = np.einsum("kcd,kd->kc", corners, np.broadcast_to(along, (len(grazing), 3)))
            distance[grazing] = np.clip(rough[grazing], reach.min(axis=1), reach.max(axis=1))
        return np.asarray(distance)

    def bary(self, face: IntArray, points: FloatArray) -> FloatArray:
        """Return barycentric coordinates (k, 3) of points (k, 3), from the centre, on faces (k,)."""
        bary = np.empty((len(face), 3))
        bary[:, 1:] = np.einsum("kcd,kd->kc", self.gradient[face], points) + self.constant[face]
        bary[:, 0] = 1.0 - bary[:, 1] - bary[:, 2]
        np.clip(bary, 0.0, 1.0, out=bary)
        bary /= bary.sum(axis=1, keepdims=True)
        return bary

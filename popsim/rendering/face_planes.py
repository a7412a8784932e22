"""Exact intersections of rays with given faces, in double precision."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray

GRAZING = 1e-2  # faces that a ray meets at a smaller sine are bounded by their corners


@dataclass(frozen=True, eq=False)
class FacePlanes:
    """The planes of `m` triangles and the barycentric coordinates in them, as linear functions of space.

    Attributes
    ----------
    corners:
        Shape (m, 3, 3).
    normals:
        Unit normals by the right-hand rule, shape (m, 3); zero for degenerate faces.
    offset:
        The plane of a face is normal . p = offset, shape (m,).
    gradient, constant:
        The coordinates of corners 1 and 2 at p are gradient . p + constant; shapes (m, 2, 3), (m, 2).
    """

    corners: FloatArray
    normals: FloatArray
    offset: FloatArray
    gradient: FloatArray
    constant: FloatArray

    @classmethod
    def of(cls, corners: FloatArray) -> "FacePlanes":
        """Return the planes of the triangles `corners` (m, 3, 3)."""
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        cross = np.cross(a, b)
        double_area = np.linalg.norm(cross, axis=1, keepdims=True)
        normals = np.divide(cross, double_area, out=np.zeros_like(cross), where=double_area > 0)
        across = np.stack([np.cross(b, normals), np.cross(normals, a)], axis=1)
        area = double_area[:, None]
        gradient = np.divide(across, area, out=np.zeros_like(across), where=area > 0)
        constant = -np.einsum("mcd,md->mc", gradient, corners[:, 0])
        return cls(corners, normals, np.einsum("md,md->m", normals, corners[:, 0]), gradient, constant)

    def scaled(self, factor: float) -> "FacePlanes":
        """Return the planes of the triangles `factor` times as large about the origin."""
        gradient = self.gradient / factor
        return FacePlanes(self.corners * factor, self.normals, self.offset * factor, gradient, self.constant)

    def distance(
        self, face: IntArray, origins: FloatArray, directions: FloatArray, rough: FloatArray
    ) -> FloatArray:
        """Return how far from their origins rays meet faces, shape (k,).

        Parameters
        ----------
        face:
            The faces that the rays are known to hit, shape (k,).
        origins, directions:
            Shape (k, 3); unit directions, or one for all, shape (1, 3).
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
            corners = self.corners[face[grazing]] - origins[grazing, None]
            reach = np.einsum("kcd,kd->kc", corners, np.broadcast_to(along, (len(grazing), 3)))
            distance[grazing] = np.clip(rough[grazing], reach.min(axis=1), reach.max(axis=1))
        return np.asarray(distance)

    def bary(self, face: IntArray, points: FloatArray) -> FloatArray:
        """Return barycentric coordinates (k, 3) of points (k, 3) on faces (k,)."""
        bary = np.empty((len(face), 3))
        bary[:, 1:] = np.einsum("kcd,kd->kc", self.gradient[face], points) + self.constant[face]
        bary[:, 0] = 1.0 - bary[:, 1] - bary[:, 2]
        np.clip(bary, 0.0, 1.0, out=bary)
        bary /= bary.sum(axis=1, keepdims=True)
        return bary

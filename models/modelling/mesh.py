"""A painted mesh: triangles with texture coordinates and a material each."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Mesh:
    """`m` triangles; nothing is shared between them, the writers weld.

    Attributes
    ----------
    triangles:
        Corners, counter-clockwise seen from outside, shape (m, 3, 3).
    uv:
        Texture coordinates per corner, v = 1 at the top of the picture, shape (m, 3, 2). While a model is being
        painted: pixels of its atlas, from the top left.
    material:
        Name of the material of each triangle, shape (m,).
    """

    triangles: FloatArray
    uv: FloatArray
    material: npt.NDArray[np.str_]

    def moved(self, x: float, y: float, z: float) -> "Mesh":
        """Return the mesh shifted by (x, y, z)."""
        return replace(self, triangles=self.triangles + np.array([x, y, z]))

    def mirrored(self) -> "Mesh":
        """Return the mirror image in the plane x = 0, paint included."""
        triangles = (self.triangles * np.array([-1.0, 1.0, 1.0]))[:, ::-1]
        return replace(self, triangles=triangles, uv=self.uv[:, ::-1])


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Return one mesh with the triangles of all `meshes`, in their order."""
    return Mesh(
        np.concatenate([m.triangles for m in meshes]),
        np.concatenate([m.uv for m in meshes]),
        np.concatenate([m.material for m in meshes]),
    )


def both_sides(part: Mesh) -> Mesh:
    """Return `part` together with its mirror image in the plane x = 0."""
    return joined([part, part.mirrored()])


def coloured(triangles: FloatArray, material: str) -> Mesh:
    """Return a mesh without texture: every triangle has the one `material`."""
    count = len(triangles)
    return Mesh(triangles, np.zeros((count, 3, 2)), np.full(count, material))


def normals(triangles: FloatArray) -> FloatArray:
    """Return the unit normals of `triangles` (m, 3, 3), shape (m, 3)."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.asarray(cross / np.linalg.norm(cross, axis=1, keepdims=True), dtype=np.float64)

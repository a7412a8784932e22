"""Faces with the same three corners: modellers paste two, back to back, to colour the sides differently."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.weld import mixed


@dataclass(frozen=True, eq=False)
class TwinFaces:
    """`k` different triangles among the `m` faces of a surface.

    Attributes
    ----------
    front:
        The face that stands for each triangle, shape (k,).
    back:
        Its first twin of the opposite orientation, or `front` again where there is none, shape (k,).
    """

    front: IntArray
    back: IntArray

    @classmethod
    def of(cls, numbers: npt.NDArray[np.int32], normals: FloatArray, holed: BoolArray) -> "TwinFaces":
        """Return the different triangles of a surface; of twins, one without holes stands first.

        Parameters
        ----------
        numbers:
            Corners as :func:`popsim.geometry.weld.corner_numbers` counts them, shape (m, 3).
        normals:
            Of the faces, shape (m, 3).
        holed:
            Faces that may have holes, shape (m,).
        """
        key = mixed(np.sort(numbers, axis=1).T.astype(np.uint64))
        order = np.argsort(key, kind="stable")
        again = key[order[1:]] == key[order[:-1]]
        twin = np.zeros(len(numbers), dtype=bool)
        twin[order[1:][again]] = twin[order[:-1][again]] = True
        alone, suspects = np.flatnonzero(~twin), np.flatnonzero(twin)
        front, back = _paired(np.sort(numbers[suspects], axis=1), normals[suspects], holed[suspects])
        fronts = np.concatenate([alone, suspects[front]])
        order = np.argsort(fronts)
        return cls(fronts[order], np.concatenate([alone, suspects[back]])[order])

    def seen(self, triangle: IntArray, normals: FloatArray, directions: FloatArray) -> IntArray:
        """Return the faces that rays along `directions` see of the triangles that they hit, shape (k,)."""
        face = self.front[triangle]
        if not self.doubled.any():
            return face
        pair = np.flatnonzero(self.doubled[triangle])
        normal = normals[face[pair]]
        along = directions if len(directions) == 1 else directions[pair]
        from_behind = np.einsum("kd,kd->k", normal, np.broadcast_to(along, normal.shape)) > 0
        face[pair[from_behind]] = self.back[triangle[pair[from_behind]]]
        return face

    @cached_property
    def doubled(self) -> BoolArray:
        """Triangles that have a twin of the opposite orientation, shape (k,)."""
        return np.asarray(self.front != self.back)


def _paired(corners: npt.NDArray[np.int32], normals: FloatArray, holed: BoolArray) -> tuple[IntArray, IntArray]:
    """The different ones among triangles with sorted corners (m, 3), and what lies at their back."""
    count = len(corners)
    order = np.lexsort((np.arange(count), holed, corners[:, 2], corners[:, 1], corners[:, 0]))
    ordered = corners[order]
    new = np.ones(count, dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    front = order[new]
    group = np.cumsum(new) - 1
    turned = np.einsum("md,md->m", normals[order], normals[front[group]]) < 0
    back = front.copy()
    groups, first = np.unique(group[turned], return_index=True)
    back[groups] = order[turned][first]
    return front.astype(np.int64), back.astype(np.int64)

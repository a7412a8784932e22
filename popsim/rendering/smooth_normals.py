"""Normals for shading: smooth over flat joints, sharp at creases. Maps keep the normals of the faces."""

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray
from popsim.geometry.weld import corner_numbers

SMOOTH = float(np.cos(np.radians(40.0)))  # joints that turn by less look round
MAX_FACES = 64  # around one corner; the rest of a fan of more adds nothing that is seen


def smooth_normals(triangles: FloatArray, normals: FloatArray) -> npt.NDArray[np.float32]:
    """Return a unit normal per corner, shape (m, 3, 3): the mean, by area, over faces that nearly continue.

    Parameters
    ----------
    triangles:
        Shape (m, 3, 3); corners at the same point are joined.
    normals:
        Unit normals of the faces, shape (m, 3). Neighbours may be turned inside out.
    """
    count = len(triangles)
    number = corner_numbers(triangles).ravel()
    order = np.argsort(number, kind="stable")
    per_vertex = np.bincount(number)
    first = np.repeat(np.cumsum(per_vertex) - per_vertex, per_vertex)
    degree = np.repeat(per_vertex, per_vertex)
    rank = np.arange(3 * count) - first
    face = order // 3
    edges = triangles[:, 1:] - triangles[:, :1]
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    total = normals[face] * area[face, None]
    for step in range(1, min(int(per_vertex.max()), MAX_FACES)):
        at = np.flatnonzero(degree > step)
        other = face[first[at] + (rank[at] + step) % degree[at]]
        turn = np.einsum("kd,kd->k", normals[face[at]], normals[other])
        weight = np.where(np.abs(turn) > SMOOTH, np.sign(turn) * area[other], 0.0)
        total[at] += weight[:, None] * normals[other]
    length = np.linalg.norm(total, axis=1, keepdims=True)
    unit = np.divide(total, length, out=np.zeros_like(total), where=length > 0)
    result = np.empty((3 * count, 3), dtype=np.float32)
    result[order] = unit
    return result.reshape(count, 3, 3)

"""Normals for shading: smooth over flat joints, sharp at creases. Maps keep the normals of the faces."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import IntArray
from popsim.geometry.extent import CHUNK
from popsim.geometry.surface import Surface

Values = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]

SMOOTH = float(np.cos(np.radians(40.0)))  # joints that turn by less look round
CONE = float(np.cos(np.radians(20.0)))  # faces within it of their mean turn from each other by less than that
MAX_FACES = 64  # around one corner; the rest of a fan of more adds nothing that is seen


def smooth_normals(surface: Surface, numbers: Indices) -> Values:
    """Return a unit normal per corner, shape (m, 3, 3): the mean, by area, over faces that nearly continue.

    Parameters
    ----------
    surface:
        Neighbours may be turned inside out.
    numbers:
        A number per corner, shape (m, 3), the same for corners at the same point, which are joined.
    """
    corners = _Corners.of(surface, numbers)
    result = np.empty((len(corners.face), 3), dtype=np.float32)
    result[corners.order] = _joined(corners)
    return result.reshape(-1, 3, 3)


class _Corners(NamedTuple):
    """All corners, those at one point beside each other.

    Attributes
    ----------
    order:
        Their indices, counted face by face, shape (n,).
    first, degree:
        Where the corners at their point start, and how many there are, shape (n,).
    face:
        Their faces, shape (n,).
    own, weighted:
        Unit normals of these faces, and the same times their areas, shape (3, n).
    """

    order: Indices
    first: Indices
    degree: Indices
    face: Indices
    own: Values
    weighted: Values

    @classmethod
    def of(cls, surface: Surface, numbers: Indices) -> "_Corners":
        number = numbers.ravel()
        order = np.argsort(number, kind="stable").astype(np.int32)
        count = np.bincount(number).astype(np.int32)
        first, degree = (np.repeat(each, count) for each in (np.cumsum(count, dtype=np.int32) - count, count))
        face = order // 3
        share = surface.areas / max(float(surface.areas.max()), 1e-300)
        own = np.ascontiguousarray(surface.normals.T, dtype=np.float32)
        weighted = (surface.normals * share[:, None]).T.astype(np.float32)
        return cls(order, first, degree, face, own[:, face], weighted[:, face])


def _joined(corners: _Corners) -> Values:
    """Normals of corners, shape (n, 3): where all faces at a point lie within a narrow cone, their mean."""
    own, weighted, first = corners.own, corners.weighted, corners.first
    starts = np.flatnonzero(first == np.arange(len(first)))
    point = np.repeat(np.arange(len(starts), dtype=np.int32), corners.degree[starts])
    side = np.where((own * own[:, first]).sum(axis=0) < 0, np.float32(-1), np.float32(1))
    mean = _unit(np.add.reduceat(weighted * side, starts, axis=1)) if len(starts) else weighted
    mean = mean[:, point] * side
    narrow = np.minimum.reduceat((own * mean).sum(axis=0), starts) > CONE if len(starts) else np.zeros(0, bool)
    rest = np.flatnonzero(~narrow[point])
    for start in range(0, len(rest), CHUNK):
        at = rest[start : start + CHUNK]
        mean[:, at] = _unit(_around(corners, at))
    return np.ascontiguousarray(mean.T)


def _around(corners: _Corners, at: IntArray) -> Values:
    """Sums over the faces that nearly continue those of some corners, shape (3, k)."""
    total = corners.weighted[:, at]
    first, degree = corners.first[at], corners.degree[at]
    for step in range(1, min(int(degree.max()), MAX_FACES)):
        more = np.flatnonzero(degree > step)
        here = at[more]
        other = first[more] + (here - first[more] + step) % degree[more]
        turn = (corners.own[:, here] * corners.own[:, other]).sum(axis=0)
        total[:, more] += (
            np.where(np.abs(turn) > SMOOTH, np.sign(turn), np.float32(0)) * corners.weighted[:, other]
        )
    return total


def _unit(vectors: Values) -> Values:
    """Vectors (3, n) of length 1; zero stays zero."""
    length = np.linalg.norm(vectors, axis=0)
    unit: Values = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return unit

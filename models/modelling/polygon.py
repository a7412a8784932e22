"""Triangles of a simple polygon."""

import numpy as np

from modelling.mesh import FloatArray, IntArray

Point = tuple[float, float]

_FLAT = 1e-12  # twice the area of a corner that does not turn


def ear_clipped(ring: FloatArray) -> IntArray:
    """Return the triangles (k - 2, 3) of a simple polygon (k, 2), turning the way the polygon turns.

    Raises
    ------
    ValueError
        No corner can be cut off: the ring has no area, or crosses itself.
    """
    x, y = ring.T
    turn = 1.0 if np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0 else -1.0
    left = list(range(len(ring)))
    triangles = []
    while len(left) > 3:
        ear = next((i for i in range(len(left)) if _is_ear(ring, left, i, turn)), None)
        if ear is None:
            raise ValueError(
                f"no corner of the ring near {ring[left[0]]} can be cut off: it has no area or crosses itself"
            )
        triangles.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    return np.array([*triangles, left], dtype=np.int64)


def _is_ear(ring: FloatArray, left: list[int], index: int, turn: float) -> bool:
    corners = [left[index - 1], left[index], left[(index + 1) % len(left)]]
    a, b, c = ring[corners]
    if turn * _doubled_area(a, b, c) <= _FLAT:
        return False
    rest = ring[[i for i in left if i not in corners]]
    sides = [turn * _doubled_area(p, q, rest) for p, q in ((a, b), (b, c), (c, a))]
    return not np.any(np.all(np.array(sides) >= -_FLAT, axis=0))


def _doubled_area(p: FloatArray, q: FloatArray, r: FloatArray) -> FloatArray:
    """Twice the signed area of the triangles p, q, r; r may be many points."""
    return np.asarray((q[0] - p[0]) * (r[..., 1] - p[1]) - (q[1] - p[1]) * (r[..., 0] - p[0]))

"""Moving the borders of prisms onto the planes that the model really has."""

from dataclasses import dataclass

import numpy as np

from popsim.fitting.knobs import knobs, limited, turned
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import BasePatchPair, Primitive

STRAIGHT = 0.95
"""|cos| of a normal to an axis above which its face lies across that axis."""

MICROMETRE = 3
"""Decimals of positions, mm: enough for paper, and free of the noise that tessellation leaves."""

STRONG = 0.004
"""Share of the model's area that a plane needs before a border is moved to it."""


@dataclass(frozen=True, eq=False)
class Planes:
    """Positions along x, u and z where much of the model's surface lies.

    Attributes
    ----------
    positions:
        Sorted, one array per axis, mm.
    weights:
        Share of the area at each position.
    """

    positions: tuple[FloatArray, FloatArray, FloatArray]
    weights: tuple[FloatArray, FloatArray, FloatArray]

    @staticmethod
    def of(points: FloatArray, normals: FloatArray, area: FloatArray, width: float) -> "Planes":
        """Planes of sample points (n, 3) with normals (n, 3) and areas (n,), gathered over `width` mm."""
        positions: list[FloatArray] = []
        weights: list[FloatArray] = []
        for axis in range(3):
            across = np.abs(normals[:, axis]) > STRAIGHT
            at = np.abs(points[across, axis]) if axis == 1 else points[across, axis]
            share = area[across] / area.sum()
            bins = np.round(at / width).astype(np.int64)
            found, index = np.unique(bins, return_inverse=True)
            weight = np.bincount(index, share, len(found))
            mean = np.bincount(index, share * at, len(found)) / np.maximum(weight, 1e-12)
            keep = weight > STRONG
            positions.append(np.round(mean[keep], MICROMETRE))
            weights.append(np.asarray(weight[keep], float))
        return Planes((positions[0], positions[1], positions[2]), (weights[0], weights[1], weights[2]))

    def snap(self, value: float, axis: int, reach: float) -> float:
        """The strongest plane within `reach` of `value`, or `value`."""
        near = np.flatnonzero(np.abs(self.positions[axis] - value) <= reach)
        if not len(near):
            return value
        return float(self.positions[axis][near[self.weights[axis][near].argmax()]])


def snapped(primitive: Primitive, pair: BasePatchPair, planes: Planes, reach: float) -> Primitive:
    """The primitive with its borders moved onto planes at most `reach` mm away, kept within its pair.

    Raises
    ------
    GeometryError
        Nothing is left of it.
    """
    moved = [(axis, planes.snap(value, axis, reach)) for axis, value in knobs(primitive)]
    return turned(primitive, [limited(knob, pair) for knob in moved])

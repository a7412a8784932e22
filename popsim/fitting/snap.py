"""Moving the borders of prisms onto the planes that the model really has."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import BasePatchPair, PairKind, Primitive, PrismRow, RectangularPrism, TriangularPrism

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
    """The primitive with its borders moved onto planes at most `reach` mm away, kept within its pair."""

    def along(x: float) -> float:
        return float(np.clip(planes.snap(x, 0, reach), *pair.x))

    def up(z: float) -> float:
        limit = np.inf if pair.kind is PairKind.OPENING else pair.v + pair.reach[1]
        return float(min(planes.snap(z, 2, reach), limit))

    def across(u: float) -> float:
        limit = min(pair.reach) if pair.kind is PairKind.OPENING else pair.u + pair.reach[0]
        return float(min(planes.snap(u, 1, reach), limit))

    if isinstance(primitive, PrismRow):
        tops = [(along(x0), along(x1), up(pair.v + h) - pair.v) for x0, x1, h in primitive.tops]
        return PrismRow(across(primitive.half_width), primitive.base, _merged(tops))
    (x0, y0, z0), (x1, y1, z1) = primitive.low, primitive.high
    x0, x1, z1 = along(x0), along(x1), up(z1)
    if isinstance(primitive, TriangularPrism):
        half = across(y1)
        return TriangularPrism((x0, -half, z0), (x1, half, z1), primitive.edges, primitive.facing)
    near, far = sorted((abs(y0), abs(y1))) if pair.kind is PairKind.CORNER else (-abs(y1), abs(y1))
    far = across(far)
    y = (near, far) if pair.kind is PairKind.CORNER else (-far, far)
    y0, y1 = sorted(pair.side.value * value for value in y)
    return RectangularPrism((x0, y0, z0), (x1, y1, z1), primitive.turned)


def _merged(tops: list[tuple[float, float, float]]) -> tuple[tuple[float, float, float], ...]:
    """Tops without the empty ones, neighbours of one height joined."""
    merged: list[tuple[float, float, float]] = []
    for x0, x1, height in tops:
        if x1 <= x0:
            continue
        if merged and abs(merged[-1][2] - height) < 1e-9:
            merged[-1] = (merged[-1][0], x1, height)
        else:
            merged.append((x0, x1, height))
    return tuple(merged)

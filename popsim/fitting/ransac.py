"""RANSAC for volumes: prisms through a few points of the model, held against all points by Eq. 1 (Sec. 4.1).

Constraints 1 and 2 leave so little open that two points make a rectangular prism on a base patch pair, its far
corners, and four a triangular one: its two ends, its width and its height.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError, InputError
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import BasePatchPair, PairKind, Primitive, PrismRow, RectangularPrism, TriangularPrism

HYPOTHESES = 1200
"""Prisms of each kind that are drawn on a pair."""

FIRST_POINTS = 120
"""Points against which all of them are held,"""

PROMISING = 40
"""and how many go on to all points."""

NEAR = 0.02
"""Points within this share of the longest side of all points are in the consensus set of a prism."""

ALIKE = 0.8
"""Prisms that share more of their consensus sets are one."""

SUM = 1e-9
"""By how much weights may miss 1."""


@dataclass(frozen=True)
class Weights:
    """Weights w1, w2, w3 of Eq. 1, each 0..1, together 1.

    Attributes
    ----------
    outliers:
        Of the share of points outside the consensus set.
    distance:
        Of the mean distance of points from the nearest face, as a share of the diagonal of all points.
    coverage:
        Of the volume around all points that is not covered. (The paper adds the covered volume itself; as an error
        that grows it would favour small prisms, which is the opposite of what the paper says of it.)
    """

    outliers: float = 0.5
    distance: float = 0.3
    coverage: float = 0.2

    def __post_init__(self) -> None:
        values = (self.outliers, self.distance, self.coverage)
        if not all(0 <= value <= 1 for value in values) or abs(sum(values) - 1) > SUM:
            named = ", ".join(f"{value:g}" for value in values)
            raise InputError(
                f"weights of Eq. 1 (outliers, distance, coverage) lie between 0 and 1 and add up to 1, not {named}"
            )

    def __str__(self) -> str:
        return f"{self.outliers:g},{self.distance:g},{self.coverage:g}"


class Hypothesis(NamedTuple):
    """A prism with its error_fit (Eq. 1), and which points are in its consensus set, shape (n,)."""

    primitive: Primitive
    error: float
    consensus: BoolArray


class _Shape(NamedTuple):
    """Prisms of one kind: how far points lie outside their faces, their volumes, and each as a primitive."""

    outside: Callable[[FloatArray], FloatArray]
    volume: FloatArray
    primitive: Callable[[int], Primitive]

    def errors(self, points: FloatArray, weights: Weights) -> tuple[FloatArray, BoolArray]:
        """Eq. 1 of all prisms (k,), and their consensus sets (k, n), over points (x, u, v) of shape (n, 3)."""
        size = np.ptp(points, axis=0)
        away = np.abs(self.outside(points))
        inliers = away <= NEAR * size.max()
        outliers, distance = 1 - inliers.mean(axis=1), away.mean(axis=1) / float(np.linalg.norm(size))
        covered = np.minimum(self.volume / max(float(size.prod()), 1e-9), 1.0)
        error = weights.outliers * outliers + weights.distance * distance + weights.coverage * (1 - covered)
        return error, inliers


def fitted_prisms(
    points: FloatArray, pair: BasePatchPair, weights: Weights, rng: Generator, most: int
) -> list[Hypothesis]:
    """Fit prisms on a base patch pair to points.

    Parameters
    ----------
    points:
        Points of the model over the pair, card frame, mm, shape (n, 3).
    pair:
        Where they stand (constraint 3).
    weights:
        Of Eq. 1.
    rng:
        Draws points.
    most:
        How many are wanted.

    Returns
    -------
    list of Hypothesis
        That with the least error first, no two of them alike.
    """
    placed = over_pair(points, pair)
    few = placed[rng.choice(len(placed), min(FIRST_POINTS, len(placed)), replace=False)]
    found: list[Hypothesis] = []
    for drawn in _kinds(pair):
        corners = placed[rng.integers(0, len(placed), (HYPOTHESES, 4))]
        shape = drawn(corners, pair)
        first = np.argsort(shape.errors(few, weights)[0], kind="stable")[:PROMISING]
        shape = drawn(corners[first], pair)
        errors, inliers = shape.errors(placed, weights)
        for k in np.argsort(errors, kind="stable"):
            try:
                found.append(Hypothesis(shape.primitive(int(k)), float(errors[k]), inliers[k]))
            except GeometryError:  # the points lie in one plane
                continue
    return _unlike(sorted(found, key=lambda hypothesis: hypothesis.error), most)


def over_pair(points: FloatArray, pair: BasePatchPair) -> FloatArray:
    """Points (n, 3) of the card frame by x, distance u from the fold line of a pair, and height v over it, mm.

    On opening pairs u counts to both sides, in corners away from the wall; shape (n, 3).
    """
    x, y, z = points.T
    u = np.abs(y) if pair.kind is PairKind.OPENING else pair.side.value * y - pair.u
    return np.column_stack([x, u, z - pair.v])


def _unlike(found: list[Hypothesis], most: int) -> list[Hypothesis]:
    """The first ones that are not like an earlier one."""
    kept: list[Hypothesis] = []
    for one in found:
        if len(kept) == most:
            break
        both = [np.count_nonzero(one.consensus & other.consensus) for other in kept]
        either = [np.count_nonzero(one.consensus | other.consensus) for other in kept]
        if all(common <= ALIKE * float(total) for common, total in zip(both, either, strict=True)):
            kept.append(one)
    return kept


def _kinds(pair: BasePatchPair) -> Iterator[Callable[[FloatArray, BasePatchPair], _Shape]]:
    yield _boxes
    if pair.kind is PairKind.OPENING:
        yield _roofs
        yield lambda corners, pair: _wedges(corners, pair, 1)
        yield lambda corners, pair: _wedges(corners, pair, -1)


def _norm(*signed: FloatArray) -> FloatArray:
    """Distance from a convex solid by how far outside each of its faces a point is; negative inside."""
    stacked = np.stack(np.broadcast_arrays(*signed))
    nearest = stacked.max(axis=0)
    beyond = np.sqrt((np.maximum(stacked, 0) ** 2).sum(axis=0))
    return np.asarray(np.where(nearest <= 0, nearest, beyond))


def _boxes(corners: FloatArray, pair: BasePatchPair) -> _Shape:
    """Rectangular prisms by two points: both ends, the farther and the higher of them."""
    low, high = corners[:, :2].min(axis=1), corners[:, :2].max(axis=1)
    x0, x1, far, top = low[:, 0], high[:, 0], np.minimum(high[:, 1], min(pair.reach)), high[:, 2]
    opening = pair.kind is PairKind.OPENING

    def outside(points: FloatArray) -> FloatArray:
        x, u, v = points.T
        along = np.maximum(x0[:, None] - x, x - x1[:, None])
        return _norm(along, u - far[:, None], v - top[:, None])

    def primitive(k: int) -> Primitive:
        a, b, w, h = (float(values[k]) for values in (x0, x1, far, top))
        if opening:
            return PrismRow(w, pair.v, ((a, b, h),))
        y0, y1 = sorted((pair.side.value * pair.u, pair.side.value * (pair.u + w)))
        return RectangularPrism((a, y0, pair.v), (b, y1, pair.v + h))

    return _Shape(outside, (x1 - x0) * far * top, primitive)


def _roofs(corners: FloatArray, pair: BasePatchPair) -> _Shape:
    """Triangular prisms along the fold by four points: both ends, the width and the height."""
    x = corners[:, :2, 0]
    x0, x1, top = x.min(axis=1), x.max(axis=1), np.maximum(corners[:, 3, 2], 1e-6)
    half = np.clip(corners[:, 2, 1], 1e-6, min(pair.reach))
    scale = np.hypot(1 / half, 1 / top)

    def outside(points: FloatArray) -> FloatArray:
        x, u, v = points.T
        along = np.maximum(x0[:, None] - x, x - x1[:, None])
        return _norm(along, (u / half[:, None] + v / top[:, None] - 1) / scale[:, None])

    def primitive(k: int) -> Primitive:
        a, b, w, h = (float(values[k]) for values in (x0, x1, half, top))
        return TriangularPrism((a, -w, pair.v), (b, w, pair.v + h), edges="x")

    return _Shape(outside, (x1 - x0) * half * top / 2, primitive)


def _wedges(corners: FloatArray, pair: BasePatchPair, facing: int) -> _Shape:
    """Upright triangular prisms by four points: the tip, the wider of two at the open end, and the height.

    The walls of a v-fold stand at 45 degrees to the fold, so a wedge is as long as it is wide to each side.
    """
    tip, top = facing * corners[:, 0, 0], np.maximum(corners[:, 3, 2], 1e-6)
    length = np.clip(corners[:, 1:3, 1].max(axis=1), 1e-6, min(pair.reach))

    def outside(points: FloatArray) -> FloatArray:
        x, u, v = facing * points[:, 0], points[:, 1], points[:, 2]
        slanted = (u + x - tip[:, None]) / np.sqrt(2)
        return _norm(slanted, tip[:, None] - length[:, None] - x, v - top[:, None])

    def primitive(k: int) -> Primitive:
        at, a, h = (float(values[k]) for values in (tip, length, top))
        x0, x1 = sorted((facing * at, facing * (at - a)))
        return TriangularPrism((x0, -a, pair.v), (x1, a, pair.v + h), "z", 1 if facing == 1 else -1)

    return _Shape(outside, length * length * top / 2, primitive)

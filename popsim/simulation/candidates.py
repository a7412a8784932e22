"""Pairs of patches that may cross, found by boxes and planes before any exact test."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.simulation.sweep import Sweep


@dataclass(frozen=True)
class Candidate:
    """Two patches, by position in the design, and the recorded angles (positions) at which they may cross."""

    pair: tuple[int, int]
    angles: tuple[int, ...]


def candidate_pairs(sweep: Sweep, frames: IntArray, least: float) -> list[Candidate]:
    """Pairs that could reach through each other by more than `least` mm at some of the recorded angles (k,).

    Each must have corners on both sides of the plane of the other, farther than `least`, and their boxes must
    overlap. Pairs that share a hinge line are left out.
    """
    places = sweep.places[frames]
    low, high = sweep.corners.least(places), sweep.corners.greatest(places)
    through = _Straddling(sweep, frames, places, least)
    joined = sweep.touching
    least_low, most_high = low.min(axis=0), high.max(axis=0)
    found = []
    for first in range(len(sweep.design.patches)):
        around = (least_low <= most_high[first]) & (most_high >= least_low[first])
        others = np.flatnonzero(around.all(axis=-1) & ~joined[first]).astype(np.int64)
        others = others[others > first]
        near = _boxes_meet(low, high, first, others)
        others, near = others[near.any(axis=0)], near[:, near.any(axis=0)]
        if not len(others):
            continue
        mask = near & through.plane_of(first, others)
        for column in np.flatnonzero(mask.any(axis=0)):
            second = int(others[column])
            both = mask[:, column] & through.plane_of(second, np.array([first]))[:, 0]
            if both.any():
                found.append(Candidate((first, second), tuple(frames[both].tolist())))
    return found


class _Straddling:
    """Whether patches have corners on both sides of another patch's plane."""

    def __init__(self, sweep: Sweep, frames: IntArray, places: FloatArray, least: float) -> None:
        self._corners = places
        self._spans = sweep.corners.spans
        self._numbers = np.arange(places.shape[1])
        self._least = least
        patches = sweep.design.patches
        turns = sweep.poses[frames][..., :3, :3]
        self._normals = (turns @ np.array([patch.plane.normal for patch in patches])[..., None])[..., 0]
        self._origins = places[:, [span.start for span in self._spans]]

    def plane_of(self, patch: int, others: IntArray) -> BoolArray:
        """For each angle, which of `others` straddle the plane of `patch`, shape (n, k)."""
        picked = [self._numbers[self._spans[k]] for k in others]
        starts = np.cumsum([0, *(len(corners) for corners in picked[:-1])])
        away = self._corners[:, np.concatenate(picked)] - self._origins[:, patch, None]
        height = (away @ self._normals[:, patch, :, None])[..., 0]
        below = np.minimum.reduceat(height, starts, axis=1) < -self._least
        above = np.maximum.reduceat(height, starts, axis=1) > self._least
        return np.asarray(below & above)


def _boxes_meet(low: FloatArray, high: FloatArray, first: int, others: IntArray) -> BoolArray:
    """For each angle, whose box meets the box of `first`, shape (n, k)."""
    ahead = low[:, others] <= high[:, first, None]
    behind = high[:, others] >= low[:, first, None]
    return np.asarray((ahead & behind).all(axis=-1))

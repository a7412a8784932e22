"""Pairs of patches that may cross, found by boxes and planes before any exact test."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.rigid import transform
from popsim.simulation.neighbours import touching
from popsim.simulation.sweep import Sweep


@dataclass(frozen=True)
class Candidate:
    """Two patches, by position in the design, and the recorded angles (positions) at which they may cross."""

    first: int
    second: int
    angles: tuple[int, ...]


def candidate_pairs(sweep: Sweep, frames: range, least: float) -> list[Candidate]:
    """Pairs that could reach through each other by more than `least` mm at some of the recorded angles `frames`.

    Each must have corners on both sides of the plane of the other, farther than `least`, and their boxes must
    overlap. Pairs that share a hinge line are left out.
    """
    corners, starts = _corners(sweep, frames)
    low = np.minimum.reduceat(corners, starts, axis=1)
    high = np.maximum.reduceat(corners, starts, axis=1)
    through = _Straddling(sweep, frames, corners, starts, least)
    joined = touching(sweep.design)
    least_low, most_high = low.min(axis=0), high.max(axis=0)
    found = []
    for first in range(len(starts)):
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
                found.append(Candidate(first, second, tuple(int(k) + frames.start for k in np.flatnonzero(both))))
    return found


class _Straddling:
    """Whether patches have corners on both sides of another patch's plane."""

    def __init__(self, sweep: Sweep, frames: range, corners: FloatArray, starts: IntArray, least: float) -> None:
        self._corners = corners
        self._bounds = np.append(starts, corners.shape[1]).astype(np.int64)
        self._least = least
        patches = sweep.design.patches
        poses = sweep.poses[frames.start : frames.stop]
        normals = np.array([patch.plane.normal for patch in patches])
        origins = np.array([patch.points[0] for patch in patches])
        self._normals = np.einsum("npij,pj->npi", poses[..., :3, :3], normals)
        self._origins = np.einsum("npij,pj->npi", poses[..., :3, :3], origins) + poses[..., :3, 3]

    def plane_of(self, patch: int, others: IntArray) -> BoolArray:
        """For each angle, which of `others` straddle the plane of `patch`, shape (n, k)."""
        picked = [np.arange(self._bounds[k], self._bounds[k + 1]) for k in others]
        starts = np.cumsum([0, *(len(corners) for corners in picked[:-1])])
        away = self._corners[:, np.concatenate(picked)] - self._origins[:, patch, None]
        height = (away @ self._normals[:, patch, :, None])[..., 0]
        below = np.minimum.reduceat(height, starts, axis=1) < -self._least
        above = np.maximum.reduceat(height, starts, axis=1) > self._least
        return np.asarray(below & above)


def _corners(sweep: Sweep, frames: range) -> tuple[FloatArray, IntArray]:
    """Hull corners of all patches, shape (n, v, 3), and where each patch starts."""
    poses = sweep.poses[frames.start : frames.stop]
    parts = [transform(poses[:, k], hull) for k, hull in enumerate(sweep.hulls)]
    starts = np.cumsum([0, *(len(hull) for hull in sweep.hulls[:-1])], dtype=np.int64)
    return np.concatenate(parts, axis=1), starts


def _boxes_meet(low: FloatArray, high: FloatArray, first: int, others: IntArray) -> BoolArray:
    """For each angle, whose box meets the box of `first`, shape (n, k)."""
    ahead = low[:, others] <= high[:, first, None]
    behind = high[:, others] >= low[:, first, None]
    return np.asarray((ahead & behind).all(axis=-1))

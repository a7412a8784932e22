"""Pairs of patches that may cross, found by boxes and planes before any exact test."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import BoolArray, IntArray
from popsim.simulation.sweep import Sweep

AT_ONCE = 2_000_000
"""Heights of corners over planes that are worked out together."""


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
    bodies = _Bodies(sweep, frames, least)
    found = []
    for block in bodies.blocks():
        others = np.flatnonzero(bodies.around(block).any(axis=0))
        mask = bodies.meet(block, others) & bodies.straddle(block, others)
        mask &= np.swapaxes(bodies.straddle(others, block), 1, 2) & bodies.around(block)[:, others]
        for row, column in np.argwhere(mask.any(axis=0)).tolist():
            pair = int(block[row]), int(others[column])
            found.append(Candidate(pair, tuple(frames[mask[:, row, column]].tolist())))
    return found


class _Bodies:
    """Corners, boxes and planes of all patches at some angles (n); `patches` and `others` are positions (k,)."""

    def __init__(self, sweep: Sweep, frames: IntArray, least: float) -> None:
        self._corners = sweep.places[frames]
        self._low, self._high = sweep.corners.least(self._corners), sweep.corners.greatest(self._corners)
        self._swept = self._low.min(axis=0), self._high.max(axis=0)
        self._apart = ~sweep.touching
        self._spans = sweep.corners.spans
        self._least = least
        turns = sweep.poses[frames][..., :3, :3]
        self._normals = (turns @ np.array([patch.plane.normal for patch in sweep.design.patches])[..., None])[
            ..., 0
        ]
        self._origins = self._corners[:, [span.start for span in self._spans]]

    def blocks(self) -> Iterator[IntArray]:
        """The patches in turns, as many at a time as memory likes."""
        size = max(1, AT_ONCE // max(1, self._corners.shape[0] * self._corners.shape[1]))
        for start in range(0, len(self._spans), size):
            yield np.arange(start, min(start + size, len(self._spans)))

    def around(self, patches: IntArray) -> BoolArray:
        """Which patches that come later in the design sweep through the same space, shape (k, p)."""
        (low, high), later = self._swept, np.arange(len(self._spans)) > patches[:, None]
        meet = (low <= high[patches, None]) & (high >= low[patches, None])
        return np.asarray(meet.all(axis=-1) & later & self._apart[patches])

    def meet(self, patches: IntArray, others: IntArray) -> BoolArray:
        """Whose boxes overlap at each angle, shape (n, k, m)."""
        ahead = self._low[:, None, others] <= self._high[:, patches, None]
        behind = self._high[:, None, others] >= self._low[:, patches, None]
        return np.asarray((ahead & behind).all(axis=-1))

    def straddle(self, patches: IntArray, others: IntArray) -> BoolArray:
        """Which `others` have corners on both sides of the planes of `patches` at each angle, shape (n, k, m)."""
        spans = [self._spans[other] for other in others]
        if not spans or not len(patches):
            return np.zeros((len(self._corners), len(patches), len(spans)), dtype=bool)
        starts = np.cumsum([0, *(span.stop - span.start for span in spans[:-1])])
        corners = self._corners[:, np.concatenate([np.arange(span.start, span.stop) for span in spans])]
        normals = self._normals[:, patches]
        height = normals @ np.swapaxes(corners, 1, 2)
        height -= (normals * self._origins[:, patches]).sum(axis=-1)[..., None]
        below = np.minimum.reduceat(height, starts, axis=2) < -self._least
        above = np.maximum.reduceat(height, starts, axis=2) > self._least
        return np.asarray(below & above)

"""Pairs of patches that may cross, found by boxes and planes before any exact test.

Two ways to cross are looked for: one patch reaches through the other at a recorded angle; or it is on one side of
the other at one angle and on the other side at the next. Parallel plates pass each other like that, all at once,
and small ones between two angles.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, IntArray
from popsim.simulation.sweep import Sweep

AT_ONCE = 2_000_000
"""Heights of corners over planes that are worked out together."""

BOTH = np.int8(2)
"""Mark of a patch that reaches through the plane of another."""

SideArray = npt.NDArray[np.int8]


@dataclass(frozen=True)
class Candidate:
    """Two patches, by position in the design, and the recorded angles (positions) at which they may cross."""

    pair: tuple[int, int]
    angles: tuple[int, ...]


@dataclass(frozen=True)
class Change:
    """A patch that was on one side of the plane of another at an angle and is on the other side at a later one.

    Attributes
    ----------
    pair:
        The patch with the plane and the one that changed sides, by position in the design.
    before, after:
        Positions of the recorded angles; between them it is in the plane.
    """

    pair: tuple[int, int]
    before: int
    after: int


def candidate_pairs(sweep: Sweep, frames: IntArray, least: float) -> list[Candidate]:
    """Pairs that could reach through each other by more than `least` mm at some of the recorded angles (k,).

    Each must have corners on both sides of the plane of the other, farther than `least`, and their boxes must
    overlap. Pairs that share a hinge line are left out.
    """
    return pairs_and_changes(sweep, frames, least)[0]


def pairs_and_changes(sweep: Sweep, frames: IntArray, least: float) -> tuple[list[Candidate], list[Change]]:
    """The same, and all patches that changed sides between two of these angles, by more than `least` mm."""
    bodies = _Bodies(sweep, frames, least)
    found: list[Candidate] = []
    changes: list[Change] = []
    for block in bodies.blocks():
        around = bodies.around(block)
        others = np.flatnonzero(around.any(axis=0))
        around = around[:, others]
        one, other = bodies.sides(block, others), bodies.sides(others, block)
        mask = bodies.meet(block, others) & (one == BOTH) & (np.swapaxes(other, 1, 2) == BOTH) & around
        for row, column in np.argwhere(mask.any(axis=0)).tolist():
            pair = int(block[row]), int(others[column])
            found.append(Candidate(pair, tuple(frames[mask[:, row, column]].tolist())))
        changes += _changes(one, frames, block, others, around)
        changes += _changes(other, frames, others, block, around.T)
    return found, changes


def _changes(
    sides: SideArray, frames: IntArray, patches: IntArray, others: IntArray, around: BoolArray
) -> Iterator[Change]:
    """Where sides (n, k, m) become opposite, of the pairs that are `around` each other (k, m)."""
    opposite = (sides == 1).any(axis=0) & (sides == -1).any(axis=0) & around
    for row, column in np.argwhere(opposite).tolist():
        off = np.flatnonzero(sides[:, row, column])
        side = sides[off, row, column].astype(np.int64)
        unbroken = frames[off[1:]] - frames[off[:-1]] == off[1:] - off[:-1]
        for k in np.flatnonzero((side[1:] == -side[:-1]) & unbroken).tolist():
            pair = int(patches[row]), int(others[column])
            yield Change(pair, int(frames[off[k]]), int(frames[off[k + 1]]))


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

    def sides(self, patches: IntArray, others: IntArray) -> SideArray:
        """Before (1) or behind (-1) the planes of `patches` lie `others` at each angle, shape (n, k, m).

        BOTH where they have corners on both sides, 0 where they lie in the plane.
        """
        spans = [self._spans[other] for other in others]
        if not spans or not len(patches):
            return np.zeros((len(self._corners), len(patches), len(spans)), dtype=np.int8)
        starts = np.cumsum([0, *(span.stop - span.start for span in spans[:-1])])
        corners = self._corners[:, np.concatenate([np.arange(span.start, span.stop) for span in spans])]
        normals = self._normals[:, patches]
        height = normals @ np.swapaxes(corners, 1, 2)
        height -= (normals * self._origins[:, patches]).sum(axis=-1)[..., None]
        below = np.minimum.reduceat(height, starts, axis=2) < -self._least
        above = np.maximum.reduceat(height, starts, axis=2) > self._least
        return np.where(below & above, BOTH, above.astype(np.int8) - below.astype(np.int8))

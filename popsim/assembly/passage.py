"""Whether paper gets past paper on the way from one place to another.

Points of one part are followed in the frame of the other: where such a point changes sides within the other's
outline, paper has gone through paper. That finds plates that jump through each other between two samples of a
motion as well as plates that cross in one; straight motions need no samples between their ends.
"""

from collections.abc import Iterable, Mapping

import numpy as np

from popsim.assembly.outline import Outline
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.rigid import transform

ASIDE = 0.3
"""mm; a point nearer to a plane than this is on neither side: it touches."""

Pair = tuple[str, str]


class Passage:
    """A motion of some parts.

    Attributes
    ----------
    outlines:
        Of all parts, by id.
    poses:
        Motions of the parts from the open pose at each sample, by part id, each of shape (n, 4, 4).
    """

    def __init__(self, outlines: Mapping[str, Outline], poses: Mapping[str, FloatArray]) -> None:
        self.outlines = outlines
        self.poses = poses
        self._points = {name: transform(pose, outlines[name].points) for name, pose in poses.items()}
        self._low = {name: points.min(axis=(0, 1)) - ASIDE for name, points in self._points.items()}
        self._high = {name: points.max(axis=(0, 1)) + ASIDE for name, points in self._points.items()}

    def collisions(self, movers: Iterable[str], others: Iterable[str]) -> list[Pair]:
        """Pairs of a mover and another part that go through each other, in order."""
        first, second = list(movers), list(others)
        hit = self._pierced(first, second) | {(a, b) for b, a in self._pierced(second, first)}
        return sorted(hit)

    def _pierced(self, points_of: list[str], plates: list[str]) -> set[Pair]:
        """Pairs in which points of the first go through the second."""
        if not points_of or not plates:
            return set()
        low, high = (np.array([box[name] for name in points_of]) for box in (self._low, self._high))
        around = low.min(axis=0), high.max(axis=0)
        found = set()
        for plate in plates:
            if (self._low[plate] > around[1]).any() or (self._high[plate] < around[0]).any():
                continue
            near = ((low <= self._high[plate]) & (high >= self._low[plate])).all(axis=1)
            names = [name for name, is_near in zip(points_of, near, strict=True) if is_near and name != plate]
            if names:
                points = np.concatenate([self._points[name] for name in names], axis=1)
                through = self._through(points, plate)
                if through.any():
                    owner = np.repeat(np.arange(len(names)), [self._points[name].shape[1] for name in names])
                    found |= {(names[k], plate) for k in np.unique(owner[through])}
        return found

    def _through(self, points: FloatArray, plate: str) -> BoolArray:
        """Which of the points (n, m, 3) change sides of a plate within its outline, shape (m,)."""
        pose, outline = self.poses[plate], self.outlines[plate]
        normal = pose[:, :3, :3] @ outline.plane.normal
        offset = ((pose[:, :3, :3] @ outline.plane.origin + pose[:, :3, 3]) * normal).sum(axis=1)
        height = (points @ normal[:, :, None])[..., 0] - offset[:, None]
        through = np.zeros(points.shape[1], dtype=bool)
        both = np.flatnonzero((height.max(axis=0) > ASIDE) & (height.min(axis=0) < -ASIDE))
        if len(both):
            through[both] = self._changes_inside(points[:, both], height[:, both], plate)
        return through

    def _changes_inside(self, points: FloatArray, height: FloatArray, plate: str) -> BoolArray:
        """Which points (n, m, 3) at heights (n, m) change sides of a plate within its outline, shape (m,)."""
        side = np.sign(height) * (np.abs(height) > ASIDE)
        latest = np.where(side != 0, np.arange(len(side))[:, None], 0)
        before = np.take_along_axis(side, np.maximum.accumulate(latest, axis=0), axis=0)[:-1]
        sample, point = np.nonzero(side[1:] * before < 0)
        start, end = height[sample, point], height[sample + 1, point]
        share = np.clip(start / (start - end), 0.0, 1.0)[:, None]
        pose = self.poses[plate]
        ends = [
            np.einsum("ki,kij->kj", points[at, point] - pose[at, :3, 3], pose[at, :3, :3])
            for at in (sample, sample + 1)
        ]
        inside = self.outlines[plate].covers((1 - share) * ends[0] + share * ends[1])
        through = np.zeros(points.shape[1], dtype=bool)
        through[point[inside]] = True
        return through

"""Folds that run through a third patch.

The two patches of a fold may each touch a third one with the fold alone, one from either side: neither crosses
it, and together they do. Folds in the bisecting plane and the backbones in it meet like that.
"""

from collections.abc import Iterator

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.rigid import transform
from popsim.simulation.contact import Depths
from popsim.simulation.sweep import Sweep

IN_PLANE = 1e-3
"""mm; a fold nearer than this to a plane lies in it. Folds farther off cross with one of their patches."""

AT_ONCE = 1_000_000
"""Coordinates of ends of folds that are held against planes together."""

SAMPLES = 17
"""Places along a fold where it is looked at, ends included."""


def find_piercings(sweep: Sweep, frames: IntArray, tolerance: float, play: float) -> Depths:
    """Folds deeper than `tolerance` mm inside a third patch at recorded angles (k,).

    `play` is the largest loop gap in mm: poses are no more exact than that.
    """
    folds = _Folds(sweep, frames, max(IN_PLANE, min(play, tolerance)), tolerance)
    found: Depths = {}
    for block in folds.blocks():
        rows, places, columns = folds.through_planes_of(block)
        for place in np.unique(places).tolist():
            here = places == place
            patch, angles = sweep.design.patches[place], frames[rows[here]]
            depths = _depths(patch, sweep.poses[angles, place], folds.axes[rows[here], columns[here]])
            for angle, column, depth in zip(angles.tolist(), columns[here].tolist(), depths.tolist(), strict=True):
                if depth > tolerance:
                    pair = (folds.hinges[column].patches[0], patch.id)
                    found.setdefault(pair, {})[angle] = depth
    return found


class _Folds:
    """All hinges but the central one, with their axes and boxes at some angles.

    `near` is how far off a plane what lies in it may be, `far` how far to its side a patch must reach, mm.
    """

    def __init__(self, sweep: Sweep, frames: IntArray, near: float, far: float) -> None:
        self._sweep, self._near, self._far = sweep, near, far
        self.hinges = [hinge for hinge in sweep.design.hinges if hinge.kind != "central"]
        self._wings = np.array(
            [[sweep.index[name] for name in hinge.patches] for hinge in self.hinges], dtype=np.int64
        ).reshape(-1, 2)
        points = np.array([hinge.points for hinge in self.hinges]).reshape(-1, 2, 3)
        self.axes = transform(sweep.poses[frames][:, self._wings[:, 0]], points)
        self._places = sweep.places[frames]
        self._low, self._high = self.axes.min(axis=2), self.axes.max(axis=2)
        self._swept = self._low.min(axis=0, initial=np.inf), self._high.max(axis=0, initial=-np.inf)
        self._joined = sweep.touching
        self._spans = sweep.corners.spans
        self._boxes = (
            sweep.corners.least(self._places) - self._near,
            sweep.corners.greatest(self._places) + self._near,
        )
        normals = np.array([patch.plane.normal for patch in sweep.design.patches])
        self._normals = (sweep.poses[frames][..., :3, :3] @ normals[..., None])[..., 0]
        self._origins = self._places[:, [span.start for span in self._spans]]

    def blocks(self) -> Iterator[IntArray]:
        """Positions of the patches in turns, as many at a time as memory likes."""
        count, size = len(self._spans), max(1, AT_ONCE // max(1, self.axes.size))
        for start in range(0, count, size):
            yield np.arange(start, min(start + size, count))

    def through_planes_of(self, block: IntArray) -> tuple[IntArray, IntArray, IntArray]:
        """Angles, patches of a block (b,) and folds, shape (k,) each, where the fold lies in the patch's plane.

        With its own two patches on either side of that, and where boxes of fold and patch meet. Folds of patches
        that share a hinge line with the patch are left out: they meet its plane there alone.
        """
        low, high = self._boxes[0].min(axis=0)[block, None], self._boxes[1].max(axis=0)[block, None]
        around = ((self._swept[0] <= high) & (self._swept[1] >= low)).all(axis=-1)
        places, columns = np.nonzero(around & ~self._joined[block][:, self._wings[:, 0]])
        places = block[places]
        away = self.axes[:, columns] - self._origins[:, places, None]
        flat = (np.abs(away @ self._normals[:, places, :, None])[..., 0] < self._near).all(axis=-1)
        rows, pairs = np.nonzero(flat)
        places, columns = places[pairs], columns[pairs]
        meet = (self._low[rows, columns] <= self._boxes[1][rows, places]) & (
            self._high[rows, columns] >= self._boxes[0][rows, places]
        )
        between = meet.all(axis=-1)
        for place in np.unique(places[between]).tolist():
            here = np.flatnonzero(between & (places == place))
            sides = self._sides(np.unique(rows[here]), place)
            first, second = (sides[rows[here], self._wings[columns[here], side]] for side in (0, 1))
            between[here] = first * second < 0
        return rows[between], places[between], columns[between]

    def _sides(self, rows: IntArray, place: int) -> IntArray:
        """Before (1) or behind (-1) the plane of a patch at each angle lies each patch, or neither (0), (k, p).

        Only asked at angles `rows`; 0 elsewhere.
        """
        away = self._places[rows] - self._origins[rows, place, None]
        height = (away @ self._normals[rows, place, :, None])[..., 0]
        low, high = self._sweep.corners.least(height), self._sweep.corners.greatest(height)
        sides = np.zeros((len(self._places), low.shape[1]), dtype=np.int64)
        sides[rows] = ((high > self._far) & (low > -self._near)).astype(np.int64)
        sides[rows] -= (low < -self._far) & (high < self._near)
        return sides


def _depths(patch: Patch, poses: FloatArray, axes: FloatArray) -> FloatArray:
    """How far inside a patch in poses (k, 4, 4) folds (k, 2, 3) run, mm, shape (k,)."""
    from shapely import distance, intersects, points, prepare

    polygon = patch.plane.polygon(patch.points, patch.hole_points)
    prepare(polygon)
    steps = np.linspace(0.0, 1.0, SAMPLES)[:, None]
    along = axes[:, :1] * (1 - steps) + axes[:, 1:] * steps
    back = (along - poses[:, None, :3, 3]) @ poses[:, :3, :3]
    places = points(patch.plane.flat(back))
    return np.asarray((distance(polygon.boundary, places) * intersects(polygon, places)).max(axis=1))

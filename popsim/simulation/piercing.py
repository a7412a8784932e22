"""Folds that run through a third patch.

The two patches of a fold may each touch a third one with the fold alone, one from either side: neither crosses
it, and together they do. Folds in the bisecting plane and the backbones in it meet like that.
"""

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.rigid import transform
from popsim.simulation.contact import Depths
from popsim.simulation.sweep import Sweep

IN_PLANE = 1e-3
"""mm; a fold nearer than this to a plane lies in it. Folds farther off cross with one of their patches."""

SAMPLES = 17
"""Places along a fold where it is looked at, ends included."""


def find_piercings(sweep: Sweep, frames: IntArray, tolerance: float, play: float) -> Depths:
    """Folds deeper than `tolerance` mm inside a third patch at recorded angles (k,).

    `play` is the largest loop gap in mm: poses are no more exact than that.
    """
    folds = _Folds(sweep, frames, max(IN_PLANE, min(play, tolerance)), tolerance)
    found: Depths = {}
    for place, patch in enumerate(sweep.design.patches):
        rows, columns = folds.through_plane_of(place)
        if not len(rows):
            continue
        depths = _depths(patch, sweep.poses[frames[rows], place], folds.axes[rows, columns])
        for row, column, depth in zip(rows.tolist(), columns.tolist(), depths.tolist(), strict=True):
            if depth > tolerance:
                pair = (folds.hinges[column].patches[0], patch.id)
                found.setdefault(pair, {})[int(frames[row])] = depth
    return found


class _Folds:
    """All hinges but the central one, with their axes and boxes at some angles.

    `near` is how far off a plane what lies in it may be, `far` how far to its side a patch must reach, mm.
    """

    def __init__(self, sweep: Sweep, frames: IntArray, near: float, far: float) -> None:
        self._sweep, self._frames, self._near, self._far = sweep, frames, near, far
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

    def through_plane_of(self, place: int) -> tuple[IntArray, IntArray]:
        """Angles and folds, shape (k,) each, where the fold lies in the plane of a patch between its own two.

        Boxes of fold and patch meet there. Folds of patches that share a hinge line with the patch are left out:
        they meet its plane there alone.
        """
        corners = self._places[:, self._sweep.corners.spans[place]]
        low, high = corners.min(axis=1) - self._near, corners.max(axis=1) + self._near
        around = (self._swept[0] <= high.max(axis=0)) & (self._swept[1] >= low.min(axis=0))
        picked = np.flatnonzero(around.all(axis=-1) & ~self._joined[place, self._wings[:, 0]])
        meet = (self._low[:, picked] <= high[:, None]) & (self._high[:, picked] >= low[:, None])
        rows, columns = np.nonzero(meet.all(axis=-1))
        columns = picked[columns]
        normals = self._sweep.poses[self._frames, place, :3, :3] @ self._sweep.design.patches[place].plane.normal
        away = self.axes[rows, columns] - corners[rows, :1]
        flat = (np.abs(away @ normals[rows, :, None])[..., 0] < self._near).all(axis=-1)
        rows, columns = rows[flat], columns[flat]
        if not len(rows):
            return rows, columns
        sides = self._sides(np.unique(rows), corners[:, 0], normals)
        between = (sides[rows, self._wings[columns, 0]] * sides[rows, self._wings[columns, 1]]) < 0
        return rows[between], columns[between]

    def _sides(self, rows: IntArray, origins: FloatArray, normals: FloatArray) -> IntArray:
        """Before (1) or behind (-1) a plane at each angle lies each patch, or neither (0), shape (k, p).

        Only asked at angles `rows`; 0 elsewhere.
        """
        height = ((self._places[rows] - origins[rows, None]) @ normals[rows, :, None])[..., 0]
        low, high = self._sweep.corners.least(height), self._sweep.corners.greatest(height)
        sides = np.zeros((len(self._frames), low.shape[1]), dtype=np.int64)
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

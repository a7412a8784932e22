"""Folds that run through a third patch.

The two patches of a fold may each touch a third one with the fold alone, one from either side: neither crosses
it, and together they do. Folds in the bisecting plane and the backbones in it meet like that.
"""

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from popsim.design import Hinge, Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.contact import Contact, closing_frames, contact_of
from popsim.simulation.neighbours import touching
from popsim.simulation.sweep import Sweep

IN_PLANE = 1e-3
"""mm; a fold nearer than this to a plane lies in it. Folds farther off cross with one of their patches."""

SAMPLES = 17
"""Places along a fold where it is looked at, ends included."""


def find_piercings(sweep: Sweep, tolerance: float, play: float) -> list[Contact]:
    """Folds deeper than `tolerance` mm inside a third patch while the card closes.

    `play` is the largest loop gap in mm: poses are no more exact than that.
    """
    near = max(IN_PLANE, min(play, tolerance))
    folds = _Folds(sweep)
    contacts = []
    for patch in sweep.design.patches if folds.hinges else ():
        depths: dict[int, dict[int, float]] = defaultdict(dict)
        for frame, fold in folds.in_plane_of(patch, near):
            if _on_both_sides(sweep, folds.hinges[fold], patch, frame, (near, tolerance)):
                pose = sweep.poses[frame, sweep.index[patch.id]]
                depths[fold][frame] = _depth(patch, pose, folds.axes[frame, fold])
        for fold, found in sorted(depths.items()):
            contact = contact_of(sweep, (folds.hinges[fold].patches[0], patch.id), found, tolerance)
            contacts += [] if contact is None else [contact]
    return contacts


class _Folds:
    """All hinges but the central one, with their axes and boxes at each angle."""

    def __init__(self, sweep: Sweep) -> None:
        self._sweep = sweep
        self._count = closing_frames(sweep)
        self.hinges = [hinge for hinge in sweep.design.hinges if hinge.kind != "central"]
        self._first = [sweep.index[hinge.patches[0]] for hinge in self.hinges]
        points = np.array([hinge.points for hinge in self.hinges]).reshape(-1, 2, 3)
        self.axes = transform(sweep.poses[: self._count, self._first], points)
        self._low, self._high = self.axes.min(axis=2), self.axes.max(axis=2)
        self._swept = self._low.min(axis=0, initial=np.inf), self._high.max(axis=0, initial=-np.inf)
        self._joined = touching(sweep.design)

    def in_plane_of(self, patch: Patch, near: float) -> Iterator[tuple[int, int]]:
        """Angles and folds at which both ends of the fold lie in the plane of `patch`, and boxes meet.

        Folds of patches that share a hinge line with `patch` are left out: they meet its plane there alone.
        """
        place = self._sweep.index[patch.id]
        corners = self._sweep.moved(patch.id, self._count)
        low, high = corners.min(axis=1) - near, corners.max(axis=1) + near
        around = (self._swept[0] <= high.max(axis=0)) & (self._swept[1] >= low.min(axis=0))
        picked = np.flatnonzero(around.all(axis=-1) & ~self._joined[place, self._first])
        meet = (self._low[:, picked] <= high[:, None]) & (self._high[:, picked] >= low[:, None])
        frames, columns = np.nonzero(meet.all(axis=-1))
        folds = picked[columns]
        normals = self._sweep.poses[: self._count, place, :3, :3] @ patch.plane.normal
        away = self.axes[frames, folds] - corners[frames, :1]
        flat = (np.abs(away @ normals[frames, :, None])[..., 0] < near).all(axis=-1)
        yield from zip(frames[flat].tolist(), folds[flat].tolist(), strict=True)


def _on_both_sides(sweep: Sweep, fold: Hinge, patch: Patch, frame: int, limits: tuple[float, float]) -> bool:
    """Whether one patch of the fold lies before the plane of a third one, and the other behind it.

    `limits`: how far each may reach to the wrong side at most, and must reach to its own at least, mm.
    """
    near, far = limits
    pose = sweep.poses[frame, sweep.index[patch.id]]
    origin, normal = pose[:3, :3] @ patch.points[0] + pose[:3, 3], pose[:3, :3] @ patch.plane.normal
    sides = []
    for name in fold.patches:
        place = sweep.index[name]
        height = (transform(sweep.poses[frame, place], sweep.hulls[place]) - origin) @ normal
        before = height.max() > far and height.min() > -near
        behind = height.min() < -far and height.max() < near
        sides.append(int(before) - int(behind))
    return sides[0] * sides[1] < 0


def _depth(patch: Patch, pose: FloatArray, axis: FloatArray) -> float:
    """How far inside the patch the fold runs, mm."""
    from shapely import distance, intersects, points

    polygon = patch.plane.polygon(patch.points, patch.hole_points)
    back = (np.linspace(axis[0], axis[1], SAMPLES) - pose[:3, 3]) @ pose[:3, :3]
    places = points(patch.plane.flat(back))
    inside = intersects(polygon, places)
    return float(np.max(distance(polygon.boundary, places) * inside))

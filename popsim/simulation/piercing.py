"""Folds that run through a third patch.

The two patches of a fold may each touch a third one with the fold alone, one from either side: neither crosses
it, and together they do. Folds in the bisecting plane and the backbones in it meet like that.
"""

from collections import defaultdict

import numpy as np

from popsim.design import Hinge, Patch
from popsim.geometry.arrays import FloatArray, IntArray
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
    hinges = [hinge for hinge in sweep.design.hinges if hinge.kind != "central"]
    if not hinges:
        return []
    count = closing_frames(sweep)
    first = [sweep.index[hinge.patches[0]] for hinge in hinges]
    axes = transform(sweep.poses[:count, first], np.array([hinge.points for hinge in hinges]))
    boxes = axes.min(axis=2), axes.max(axis=2)
    apart = touching(sweep.design)
    contacts = []
    for place, patch in enumerate(sweep.design.patches):
        frames, folds = _inside(sweep, patch, axes, boxes, near)
        depths: dict[int, dict[int, float]] = defaultdict(dict)
        for frame, fold in zip(frames.tolist(), folds.tolist(), strict=True):
            if not apart[place, first[fold]]:
                pose = sweep.poses[frame, place]
                if _on_both_sides(sweep, hinges[fold], patch, frame, (near, tolerance)):
                    depths[fold][frame] = _depth(patch, pose, axes[frame, fold])
        for fold, found in sorted(depths.items()):
            contact = contact_of(sweep, (hinges[fold].patches[0], patch.id), found, tolerance)
            contacts += [] if contact is None else [contact]
    return contacts


def _inside(
    sweep: Sweep, patch: Patch, axes: FloatArray, boxes: tuple[FloatArray, FloatArray], near: float
) -> tuple[IntArray, IntArray]:
    """Frames and folds at which both ends of the fold lie in the plane of `patch`, and boxes meet."""
    corners = sweep.moved(patch.id, len(axes))
    low, high = corners.min(axis=1) - near, corners.max(axis=1) + near
    frames, folds = np.nonzero(((boxes[0] <= high[:, None]) & (boxes[1] >= low[:, None])).all(axis=-1))
    normals = sweep.poses[: len(axes), sweep.index[patch.id], :3, :3] @ patch.plane.normal
    away = axes[frames, folds] - corners[frames, :1]
    flat = (np.abs(away @ normals[frames, :, None])[..., 0] < near).all(axis=-1)
    return frames[flat].astype(np.int64), folds[flat].astype(np.int64)


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

"""How far two patches can turn about their hinge before they lie face to face."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design, Hinge, Patch
from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from shapely.geometry import Polygon

OVERLAP = 0.5
"""mm^2; two patches that would lie on each other by less than this when face to face do not stop each other."""

TOUCHING = 1e-6
"""rad; patches that lie face to face when open are not guarded: which way they part is not known."""

BESIDE = 0.05
"""mm; a patch that reaches less than this to one side of its hinge lies on the other alone."""

FAR = 1e6
"""mm; beyond every design."""


@dataclass(frozen=True)
class Turn:
    """Free turning of the second patch of a hinge against the first, about its axis, from the open pose.

    Attributes
    ----------
    hinge:
        The hinge; turning is right-handed about the direction from the first to the second end of its axis.
    lower, upper:
        rad. Paper in the way on either side; infinite where nothing is.
    """

    hinge: Hinge
    lower: float
    upper: float


def free_turn(design: Design, hinge: Hinge) -> Turn:
    """Where the two patches of `hinge` would lie on each other if they turned that far."""
    axis = (hinge.points[1] - hinge.points[0]) / hinge.length
    first, second = (design.patch_by_id[name] for name in hinge.patches)
    between = angle_between(design, hinge)
    halves = [_halves(patch, hinge, axis) for patch in (first, second)]
    lower, upper = -np.inf, np.inf
    for side, part in halves[0].items():
        for other, piece in halves[1].items():
            if part.intersection(piece).area > OVERLAP:
                apart = (between + (np.pi if side != other else 0.0)) % (2 * np.pi)
                if min(apart, 2 * np.pi - apart) > TOUCHING:
                    lower, upper = max(lower, -apart), min(upper, 2 * np.pi - apart)
    return Turn(hinge, lower, upper)


def angle_between(design: Design, hinge: Hinge) -> float:
    """Angle in the open pose from the first patch of `hinge` to the second, rad, right-handed about its axis.

    Between the sides to which the normal of each patch turned by the axis points; whether a patch lies there or
    on the other side of its hinge (or on both) is not asked.
    """
    axis = (hinge.points[1] - hinge.points[0]) / hinge.length
    first, second = (np.cross(design.patch_by_id[name].plane.normal, axis) for name in hinge.patches)
    return float(np.arctan2(axis @ np.cross(first, second), first @ second))


def turned(hinge: Hinge, first: FloatArray, second: FloatArray) -> FloatArray:
    """Turning about `hinge` in the poses (n, 4, 4) of its two patches, rad, continued from 0, shape (n,)."""
    axis = (hinge.points[1] - hinge.points[0]) / hinge.length
    across = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    upright = np.cross(axis, across)
    relative = np.swapaxes(first[:, :3, :3], -1, -2) @ second[:, :3, :3]
    moved = relative @ across
    return np.asarray(np.unwrap(np.arctan2(moved @ upright, moved @ across)))


def _halves(patch: Patch, hinge: Hinge, axis: FloatArray) -> dict[int, "Polygon"]:
    """The parts of a patch on either side of an axis, in coordinates along it and away from it."""
    from shapely.geometry import Polygon, box

    away = np.cross(patch.plane.normal, axis)
    flat = [
        np.stack([(ring - hinge.points[0]) @ axis, (ring - hinge.points[0]) @ away], axis=-1)
        for ring in (patch.points, *patch.hole_points)
    ]
    halves = {}
    for side in (1, -1):
        reach = side * flat[0][:, 1]
        if reach.max() > BESIDE:
            half = Polygon(flat[0] * [1, side], [hole * [1, side] for hole in flat[1:]])
            halves[side] = half if reach.min() >= -BESIDE else half.intersection(box(-FAR, 0.0, FAR, FAR))
    return halves

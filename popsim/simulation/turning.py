"""How far two patches can turn about their hinge before they lie face to face."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from popsim.design import Design, Hinge
from popsim.geometry.arrays import FloatArray, IntArray, cross

OVERLAP = 0.5
"""mm^2; two patches that would lie on each other by less than this when face to face do not stop each other."""

TOUCHING = 1e-6
"""rad; patches that lie face to face when open are not guarded: which way they part is not known."""

BESIDE = 0.05
"""mm; a patch that reaches less than this to one side of its hinge lies on the other alone."""

FAR = 1e6
"""mm; beyond every design."""

SIDES = (1, -1)
"""Of a hinge: where the normal of a patch turned by the axis points, and the other one."""


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
    return free_turns(design, [hinge])[hinge.id]


def turns_of(design: Design) -> dict[str, Turn]:
    """The same of all hinges but the central one, by their ids."""
    return free_turns(design, [hinge for hinge in design.hinges if hinge.kind != "central"])


def free_turns(design: Design, hinges: Sequence[Hinge]) -> dict[str, Turn]:
    """The same of some hinges, by their ids."""
    from shapely import area, intersection

    if not hinges:
        return {}
    halves = _halves(design, hinges)
    between = angles_between(design, hinges)
    lower, upper = np.full(len(hinges), -np.inf), np.full(len(hinges), np.inf)
    for k, side in enumerate(SIDES):
        for m, other in enumerate(SIDES):
            faces = area(intersection(halves[:, 0, k], halves[:, 1, m])) > OVERLAP
            apart = (between + (np.pi if side != other else 0.0)) % (2 * np.pi)
            stops = faces & (np.minimum(apart, 2 * np.pi - apart) > TOUCHING)
            lower = np.where(stops, np.maximum(lower, -apart), lower)
            upper = np.where(stops, np.minimum(upper, 2 * np.pi - apart), upper)
    limits = zip(hinges, lower.tolist(), upper.tolist(), strict=True)
    return {hinge.id: Turn(hinge, low, high) for hinge, low, high in limits}


def angles_between(design: Design, hinges: Sequence[Hinge]) -> FloatArray:
    """Angle in the open pose from the first patch of each hinge to the second, rad, shape (h,).

    Right-handed about its axis, between the sides to which the normal of each patch turned by the axis points;
    whether a patch lies there or on the other side of its hinge (or on both) is not asked.
    """
    axes, away = _directions(design, hinges)
    first, second = away[:, 0], away[:, 1]
    return np.asarray(np.arctan2((axes * cross(first, second)).sum(axis=-1), (first * second).sum(axis=-1)))


def turned(hinge: Hinge, first: FloatArray, second: FloatArray) -> FloatArray:
    """Turning about `hinge` in the poses (n, 4, 4) of its two patches, rad, continued from 0, shape (n,)."""
    return turnings([hinge], first[:, None], second[:, None])[:, 0]


def turnings(hinges: Sequence[Hinge], first: FloatArray, second: FloatArray) -> FloatArray:
    """The same of several hinges, in poses (n, h, 4, 4) of their patches, shape (n, h)."""
    axes = _axes(hinges)
    aside = np.where(np.abs(axes[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    across = cross(axes, aside)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    upright = cross(axes, across)
    moved = second[..., :3, :3] @ across[..., None]
    back = np.swapaxes(first[..., :3, :3], -1, -2) @ moved
    turn = np.arctan2((back[..., 0] * upright).sum(axis=-1), (back[..., 0] * across).sum(axis=-1))
    return np.asarray(np.unwrap(turn, axis=0))


def _axes(hinges: Sequence[Hinge]) -> FloatArray:
    """Unit directions of the axes, shape (h, 3)."""
    points = np.array([hinge.points for hinge in hinges]).reshape(-1, 2, 3)
    along = points[:, 1] - points[:, 0]
    return np.asarray(along / np.linalg.norm(along, axis=-1, keepdims=True))


def _directions(design: Design, hinges: Sequence[Hinge]) -> tuple[FloatArray, FloatArray]:
    """Axes, shape (h, 3), and the normals of both patches turned by them, in the patches, shape (h, 2, 3)."""
    axes = _axes(hinges)
    normals = [[design.patch_by_id[name].plane.normal for name in hinge.patches] for hinge in hinges]
    return axes, cross(np.array(normals).reshape(-1, 2, 3), axes[:, None])


def _halves(design: Design, hinges: Sequence[Hinge]) -> Any:
    """The parts of both patches of each hinge on either side of it, along it and away from it.

    Polygons or None, shape (h, 2, 2): hinge, patch, side.
    """
    from shapely import box, intersection, linearrings, polygons

    axes, away = _directions(design, hinges)
    flat, rings, wholes = [], [], []
    for hinge, axis, outward in zip(hinges, axes, away, strict=True):
        for name, direction in zip(hinge.patches, outward, strict=True):
            patch = design.patch_by_id[name]
            basis, origin = np.array([axis, direction]).T, hinge.points[0]
            for ring in (patch.points, *patch.hole_points):
                flat.append((ring - origin) @ basis)
                rings.append(len(ring))
                wholes.append(ring is patch.points)
    points, which = np.concatenate(flat), np.repeat(np.arange(len(rings)), rings)
    owner = np.cumsum(wholes) - 1
    halves = np.full((2 * len(hinges), 2), None, dtype=object)
    for k, side in enumerate(SIDES):
        whole = polygons(linearrings(points * [1.0, side], indices=which), indices=owner)
        low, high = _reaches(points[:, 1] * side, which, owner)
        halves[high > BESIDE, k] = whole[high > BESIDE]
        cut = (high > BESIDE) & (low < -BESIDE)
        halves[cut, k] = intersection(whole[cut], box(-FAR, 0.0, FAR, FAR))
    return halves.reshape(len(hinges), 2, 2)


def _reaches(heights: FloatArray, which: IntArray, owner: IntArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest height of the corners of each polygon, shape (k,) each."""
    starts = np.flatnonzero(np.diff(owner[which], prepend=-1))
    return np.minimum.reduceat(heights, starts), np.maximum.reduceat(heights, starts)

"""Finding the walls and the roof of a v-fold among the patches of a design, and measuring how true they are."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.design import Hinge
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.mechanisms.condition import Condition, identity
from popsim.mechanisms.members import Members, along_x

SLANT = 0.2
"""How far |dx| and |dy| of a base hinge may differ, of their sum, before it is no wall of a v-fold at all."""


@dataclass(frozen=True)
class Part:
    """Patches with their roles, and the conditions measured on them."""

    roles: Mapping[str, str]
    conditions: tuple[Condition, ...]


@dataclass(frozen=True)
class Walls:
    """The two front walls: where they leave the fold line, how wide and high they are, which way they face."""

    part: Part
    left: str
    right: str
    axes: tuple[FloatArray, FloatArray]
    tip: float
    width: float
    height: float
    facing: Literal[1, -1]


@dataclass(frozen=True)
class Roof:
    """The two roof halves and the height they lie at."""

    part: Part
    height: float


def find_walls(members: Members) -> Walls | str:
    """The front walls, or what is missing."""
    on_ground, on_backdrop = members.on_base(0), members.on_base(1)
    if not len(on_ground) == len(on_backdrop) == 1:
        return "one wall hinged to each base patch"
    (left, foot_l), (right, foot_r) = on_ground[0], on_backdrop[0]
    axes = (_away_from_fold(foot_l), _away_from_fold(foot_r))
    slants = [axis[1] - axis[0] for axis in axes]
    if any(abs(abs(d[0]) - abs(d[1])) > SLANT * (abs(d[0]) + abs(d[1])) for d in slants):
        return "two walls that leave the fold line at 45 degrees"
    edge = members.between(left, right)
    if edge is None or slants[0][0] * slants[1][0] <= 0:
        return "two walls that share a fold over their tip and open to the same end"
    tips = [float(axis[0, 0] - d[0] * axis[0, 1] / d[1]) for axis, d in zip(axes, slants, strict=True)]
    upright = np.array([[tips[0], 0.0, 0.0], [tips[0], 0.0, 1.0]])
    conditions = (
        identity("foldable", members.id, f"{left} leaves the fold line at 45 degrees", _off_45(slants[0])),
        identity("foldable", members.id, f"{right} leaves the fold line at 45 degrees", _off_45(slants[1])),
        identity("foldable", members.id, "both walls leave one point", tips[0] - tips[1]),
        identity("foldable", members.id, "front fold upright", float(line_distance(edge.points, upright).max())),
    )
    facing: Literal[1, -1] = 1 if slants[0][0] < 0 else -1
    corners = np.concatenate([members.patch(name).points for name in (left, right)])
    width = float((facing * (tips[0] - corners[:, 0])).max() * np.sqrt(2))
    height = float(corners[:, 2].max() - members.pair.v)
    part = Part({left: "F_L", right: "F_R"}, conditions)
    return Walls(part, left, right, axes, tips[0], width, height, facing)


def find_roof(members: Members, walls: Walls) -> Roof | str | None:
    """The roof, None where there is none, or what is missing of one."""
    halves: list[tuple[str, Hinge]] = []
    for wall in (walls.left, walls.right):
        for name, hinge in members.neighbours(wall):
            if name not in (walls.left, walls.right) and np.ptp(hinge.points[:, 2]) < np.ptp(hinge.points[:, 0]):
                halves.append((name, hinge))
    if not halves:
        return None
    if len(halves) != 2:
        return "one roof half on each front wall"
    (first, left), (second, right) = halves
    ridge = members.between(first, second)
    if ridge is None or not along_x(ridge):
        return "a fold along x between the roof halves"
    heights = [float(hinge.points[:, 2].mean() - members.pair.v) for hinge in (left, right)]
    above = [_shifted(axis, h) for axis, h in zip(walls.axes, heights, strict=True)]
    conditions = (
        identity("foldable", members.id, "roof halves at one height", heights[0] - heights[1]),
        identity(
            "foldable", members.id, f"{first} over its wall", float(line_distance(left.points, above[0]).max())
        ),
        identity(
            "foldable", members.id, f"{second} over its wall", float(line_distance(right.points, above[1]).max())
        ),
        identity("foldable", members.id, "ridge in the bisecting plane", float(np.abs(ridge.points[:, 1]).max())),
        identity(
            "foldable", members.id, "ridge at roof height", float(ridge.points[:, 2].mean()) - above[0][0, 2]
        ),
    )
    return Roof(Part({first: "T_G", second: "T_B"}, conditions), heights[0])


def _away_from_fold(hinge: Hinge) -> FloatArray:
    """Axis of a hinge, the end nearer to the fold line first, shape (2, 3)."""
    points = hinge.points
    return points if abs(points[0, 1]) <= abs(points[1, 1]) else points[::-1]


def _off_45(direction: FloatArray) -> float:
    return float(abs(abs(direction[0]) - abs(direction[1])) / np.sqrt(2))


def _shifted(axis: FloatArray, height: float) -> FloatArray:
    return np.asarray(axis + np.array([0.0, 0.0, height]))

"""What both types of v-fold share: two front walls, a roof in two halves, and how they lean (Sec. 3.2.3)."""

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import sqrt
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.frame import MINUS_Z, X_AXIS, Z_AXIS, Side, page_direction
from popsim.geometry.rigid import Frame
from popsim.mechanisms.base import Mechanism, Recognition, require_positive
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind
from popsim.mechanisms.plate import (
    FIRST_BASE,
    SECOND_BASE,
    Face,
    Joint,
    Line,
    Plate,
    Point,
    joints_from,
    plates_from,
)
from popsim.mechanisms.primitive import Corner, RectangularPrism, TriangularPrism
from popsim.mechanisms.room import LEAST, Room, draw
from popsim.mechanisms.v_fold_parts import Part, Walls, find_roof, find_walls

ROOF_DEPTH = 0.75
"""Share of the height down to which the model shows on a roof."""

SIDES = ((Side.GROUND, "L", "G"), (Side.BACKDROP, "R", "B"))
"""Side, letter of its walls, letter of its roof half."""


@dataclass(frozen=True)
class VFold(Mechanism):
    """Walls of `width` and `height` that leave the `tip` on the fold line at 45 degrees, backward from `facing`.

    In the open pose F_L and F_R stand upright; their base hinges run along u = (-f/sqrt2, +-sin a/sqrt2,
    cos a/sqrt2) and their common fold along e = (f cos a, 0, 1)/sqrt(1 + cos^2 a), f = 1 facing +x, -1 facing -x.
    The roof halves T_G, T_B stay parallel to the base.
    """

    tip: float
    width: float
    height: float
    facing: Literal[1, -1] = 1
    roof: bool = True

    pair_kind = PairKind.OPENING
    depth: ClassVar[float]
    """How far the v-fold reaches behind its tip when open, in widths."""

    def _check_parameters(self) -> None:
        require_positive(self, width=self.width, height=self.height)
        if self.facing not in (1, -1):
            raise GeometryError(f"{self.id}: a v-fold faces 1 or -1 along x, not {self.facing}")

    @property
    def back(self) -> float:
        """Where it ends behind the tip when open, mm along x."""
        return self.tip - self.facing * self.depth * self.width

    def wall_direction(self, side: Side, theta: FloatArray) -> FloatArray:
        """Direction of the base hinge of a front wall, away from the tip, shape (n, 3)."""
        return np.asarray((page_direction(side, theta) - self.facing * X_AXIS) / np.sqrt(2))

    def edge_direction(self, theta: FloatArray) -> FloatArray:
        """Direction of the fold between the front walls, upward, shape (n, 3)."""
        cos = np.cos(np.asarray(theta, float) / 2)
        lean = np.stack([self.facing * cos, 0 * cos, 1 + 0 * cos], axis=-1)
        return np.asarray(lean / np.sqrt(1 + cos**2)[:, None])

    def plates(self) -> tuple[Plate, ...]:
        return plates_from(self._faces())

    def joints(self) -> tuple[Joint, ...]:
        return joints_from(self._lines())

    def _faces(self) -> list[Face]:
        walls: list[Face] = []
        roof: list[Face] = []
        foot, end = self.foot, self.end
        for side, wall, half in SIDES:
            corner = self.corner(side)
            outward = diagonal(self.facing, side.value)
            face = [foot, corner, self._risen(corner), self._risen(foot)]
            walls.append(Face(f"F_{wall}", face, outward, behind=self.width))
            top = [self._risen(point) for point in (foot, corner, end)]
            roof.append(Face(f"T_{half}", top, Z_AXIS, behind=ROOF_DEPTH * self.height))
        return [*walls, *roof] if self.roof else walls

    def _lines(self) -> list[Line]:
        foot, end = self.foot, self.end
        left, right = self.corner(Side.GROUND), self.corner(Side.BACKDROP)
        tip = self._risen(foot)
        walls = [
            Line((FIRST_BASE, "F_L"), foot, left, "glue"),
            Line((SECOND_BASE, "F_R"), foot, right, "glue"),
            Line(("F_L", "F_R"), foot, tip, "fold"),
        ]
        roof = [
            Line(("F_L", "T_G"), tip, self._risen(left), "glue"),
            Line(("F_R", "T_B"), tip, self._risen(right), "glue"),
            Line(("T_G", "T_B"), tip, self._risen(end), "fold", MINUS_Z),
        ]
        return walls + roof if self.roof else walls

    def _risen(self, point: Point) -> Point:
        """What is over a point of the base at its height."""
        return point[0], point[1], point[2] + self.height

    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        edge = self.edge_direction(theta)
        along = np.broadcast_to(X_AXIS, edge.shape)
        frames = {}
        for side, wall, half in SIDES:
            frames[f"F_{wall}"] = Frame(0 * edge + self.foot, self.wall_direction(side, theta), edge)
            if self.roof:
                frames[f"T_{half}"] = Frame(self.foot + self.height * edge, along, page_direction(side, theta))
        return frames

    def pairs(self) -> tuple[BasePatchPair, ...]:
        return ()

    def closing_range(self) -> tuple[float, float]:
        low, high = sorted((self.back, self.tip + self.facing * self.height / np.sqrt(2)))
        return float(low), float(high)

    @property
    def foot(self) -> Point:
        """The tip on the fold line."""
        return self.tip, 0.0, self.pair.v

    @property
    def end(self) -> Point:
        """Where it ends on the fold line, behind the tip."""
        return self.back, 0.0, self.pair.v

    def corner(self, side: Side) -> Point:
        """Far end of the base hinge on one side, open pose."""
        half = self.width / sqrt(2)
        return self.tip - self.facing * half, side.value * half, self.pair.v

    @classmethod
    def recognise(cls, members: Members) -> Recognition:
        walls = find_walls(members)
        if isinstance(walls, str):
            return Recognition.unlike(members.id, walls)
        roof = find_roof(members, walls)
        if isinstance(roof, str):
            return Recognition.unlike(members.id, roof)
        height = walls.height if roof is None else roof.height
        fold = cls(members.id, members.pair, walls.tip, walls.width, height, walls.facing, roof is not None)
        rest = fold.find_rest(members, walls)
        if isinstance(rest, str):
            return Recognition.unlike(members.id, rest)
        fold, parts = rest
        found = [walls.part, *([] if roof is None else [roof.part]), *parts]
        roles = {name: role for part in found for name, role in part.roles.items()}
        if set(roles) != set(members.record.patches):
            extra = sorted(set(members.record.patches) - set(roles))
            return Recognition.unlike(members.id, f"no place in a {cls.type} for {', '.join(extra)}")
        return Recognition(fold, tuple(c for part in found for c in part.conditions), roles)

    @classmethod
    def random(cls, rng: Generator, pair: BasePatchPair, id: str, room: Room) -> Self | None:
        facing: Literal[1, -1] = 1 if rng.random() < 0.5 else -1
        free = room if facing == 1 else room.mirrored()
        feet = free.within(*sorted(facing * end for end in pair.x)).x
        left = room.extent - pair.v
        least_rise = LEAST / np.sqrt(2)
        front = min(feet[1], free.x[1] - least_rise)
        widest = min((front - feet[0]) / cls.depth, min(pair.reach) * np.sqrt(2), (left - least_rise) / np.sqrt(2))
        if widest < LEAST:
            return None
        width = draw(rng, LEAST, widest)
        tip = draw(rng, feet[0] + cls.depth * width, front)
        height = draw(rng, LEAST, min((free.x[1] - tip) * np.sqrt(2), left * np.sqrt(2) - 2 * width))
        return cls(id, pair, facing * tip, width, height, facing, bool(rng.random() < 0.7))

    def faults(self) -> tuple[Fault, ...]:
        corner = self.corner(Side.GROUND)
        line = np.array([corner, self._risen(corner)])
        roles = tuple(plate.role for plate in self.plates() if plate.role in ("F_L", "B_L", "T_G"))
        return (Fault("walls at 45 degrees", roles, line, self.facing * X_AXIS, self.width / 3),)

    @abstractmethod
    def find_rest(self, members: Members, walls: Walls) -> tuple[Self, list[Part]] | str:
        """Recognise what the type adds to walls and roof; a string says what is missing."""

    def _box(self) -> tuple[Corner, Corner]:
        """Opposite corners of the box around the primitive."""
        x0, x1 = sorted((self.tip, self.back))
        half, v = self.width / float(np.sqrt(2)), self.pair.v
        return (x0, -half, v), (x1, half, v + self.height)

    @classmethod
    def _from_box(
        cls,
        primitive: RectangularPrism | TriangularPrism,
        pair: BasePatchPair,
        id: str,
        facings: tuple[Literal[1, -1], ...],
    ) -> Iterator[Self]:
        """v-folds in the box around `primitive`, one per facing, where the pair has room."""
        (x0, y0, _), (x1, y1, z1) = primitive.low, primitive.high
        half, height = min(-y0, y1), z1 - pair.v
        width = min(half * np.sqrt(2), (x1 - x0) / cls.depth)
        if pair.kind is not cls.pair_kind or not (0 < half <= min(pair.reach) and height > 0):
            return
        if pair.x[0] <= x0 and x1 <= pair.x[1]:
            for facing in facings:
                yield cls(id, pair, x1 if facing == 1 else x0, float(width), height, facing)


@cache
def diagonal(x: int, y: int) -> FloatArray:
    """Unit direction half way between two axes, either way of each, shape (3,)."""
    return locked(np.array([x, y, 0.0]) / np.sqrt(2), (3,), "direction")

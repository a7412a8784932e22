"""What both types of v-fold share: two front walls, a roof in two halves, and how they lean (Sec. 3.2.3)."""

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN, X_AXIS, Z_AXIS, Side, page_direction
from popsim.geometry.rigid import Frame
from popsim.mechanisms.base import (
    FIRST_BASE,
    SECOND_BASE,
    Joint,
    Mechanism,
    Plate,
    Recognition,
    require_positive,
)
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind
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
        rise = self.height * Z_AXIS
        walls: list[Plate] = []
        roof: list[Plate] = []
        for side, wall, half in SIDES:
            corner = self.corner(side)
            outward = np.array([self.facing, side.value, 0.0]) / np.sqrt(2)
            foot = self.foot
            face = np.array([foot, corner, corner + rise, foot + rise])
            walls.append(Plate(f"F_{wall}", face, outward, behind=self.width))
            end = np.array([self.back, 0.0, self.pair.v])
            face = np.array([foot, corner, end]) + rise
            roof.append(Plate(f"T_{half}", face, Z_AXIS, behind=ROOF_DEPTH * self.height))
        return (*walls, *roof) if self.roof else tuple(walls)

    def joints(self) -> tuple[Joint, ...]:
        foot, rise = self.foot, self.height * Z_AXIS
        left, right = self.corner(Side.GROUND), self.corner(Side.BACKDROP)
        end = np.array([self.back, 0.0, self.pair.v])
        walls = (
            Joint((FIRST_BASE, "F_L"), np.array([foot, left]), "glue"),
            Joint((SECOND_BASE, "F_R"), np.array([foot, right]), "glue"),
            Joint(("F_L", "F_R"), np.array([foot, foot + rise]), "fold"),
        )
        roof = (
            Joint(("F_L", "T_G"), np.array([foot, left]) + rise, "glue"),
            Joint(("F_R", "T_B"), np.array([foot, right]) + rise, "glue"),
            Joint(("T_G", "T_B"), np.array([foot, end]) + rise, "fold", -Z_AXIS),
        )
        return walls + roof if self.roof else walls

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
    def foot(self) -> FloatArray:
        """The tip on the fold line, shape (3,)."""
        return np.array([self.tip, 0.0, self.pair.v])

    def corner(self, side: Side) -> FloatArray:
        """Far end of the base hinge on one side, open pose, shape (3,)."""
        return np.asarray(self.foot + self.width * self.wall_direction(side, np.array([OPEN]))[0])

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
        line = np.array([corner, corner + self.height * Z_AXIS])
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

"""Tent-fold: two slopes that meet in a ridge over the fold line (Sec. 3.2.2, Fig. 5b)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.frame import X_AXIS, Side, page_direction
from popsim.geometry.rigid import Frame
from popsim.mechanisms.base import Mechanism, Recognition, require_positive
from popsim.mechanisms.condition import Condition, identity
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
    joints_from,
    plates_from,
    rectangle,
)
from popsim.mechanisms.primitive import Primitive, TriangularPrism
from popsim.mechanisms.room import LEAST, Room, draw, draw_interval

EAVES = 0.3
"""Share of a slope that it may go on below its foot."""

LONGEST_EAVES = 10.0
"""mm; more would be in the way of what stands beside."""

OVER_EDGE = 1e-6
"""mm; a foot this near to the edge of a top stands on it."""


@dataclass(frozen=True)
class TentFold(Mechanism):
    """A roof over x on an opening pair: half base t1, ridge `height` above the fold line when open.

    T_1 and T_2 are strips of the base, T_3 (ground side) and T_4 the slopes, |T_3| = sqrt(t1^2 + height^2). The
    ridge stays in the bisecting plane, at t1 cos a + sqrt(t3^2 - t1^2 sin^2 a). It does not move along x.
    """

    x: tuple[float, float]
    t1: float
    height: float

    type = "tent-fold"
    pair_kind = PairKind.OPENING

    @property
    def t3(self) -> float:
        """Length of a slope, |T_3| = |T_4|, mm."""
        return float(np.hypot(self.t1, self.height))

    @property
    def _eaves(self) -> float:
        """How far slopes may go on below their feet, mm: only over the edge of a top, past its sides."""
        over_edge = self.pair.owner is not None and self.t1 >= min(self.pair.reach) - OVER_EDGE
        return min(EAVES * self.t3, LONGEST_EAVES) if over_edge else 0.0

    def _check_parameters(self) -> None:
        require_positive(self, length=self.x[1] - self.x[0], t1=self.t1, height=self.height)

    def plates(self) -> tuple[Plate, ...]:
        v, ridge = self.pair.v, (0.0, self.pair.v + self.height)
        beyond, depth = self._eaves / self.t3, self.t1 * self.height / self.t3
        slopes = []
        for side, role in _SLOPES:
            foot = (side.value * self.t1, v)
            eaves = (foot[0] * (1 + beyond), v - beyond * self.height)
            outward = locked([0.0, side.value * self.height / self.t3, self.t1 / self.t3], (3,), "outward")
            room = rectangle(self.x, eaves, ridge)
            slopes.append(Face(role, rectangle(self.x, foot, ridge), outward, room=room, behind=depth))
        return plates_from(slopes)

    def joints(self) -> tuple[Joint, ...]:
        (x0, x1), v, top = self.x, self.pair.v, self.pair.v + self.height
        return joints_from(
            [
                Line((FIRST_BASE, "T_3"), (x0, self.t1, v), (x1, self.t1, v), "glue"),
                Line((SECOND_BASE, "T_4"), (x0, -self.t1, v), (x1, -self.t1, v), "glue"),
                Line(("T_3", "T_4"), (x0, 0.0, top), (x1, 0.0, top), "fold"),
            ]
        )

    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        alpha = np.asarray(theta, float) / 2
        rise = np.sqrt(self.t3**2 - (self.t1 * np.sin(alpha)) ** 2)
        ridge = (self.t1 * np.cos(alpha) + rise)[:, None] * Z_ROW + self.pair.v * Z_ROW
        frames = {}
        for side, role in _SLOPES:
            foot = self.t1 * page_direction(side, theta) + self.pair.v * Z_ROW
            up = (ridge - foot) / self.t3
            frames[role] = Frame(foot, np.broadcast_to(X_AXIS, up.shape), up)
        return frames

    def pairs(self) -> tuple[BasePatchPair, ...]:
        return ()

    def closing_range(self) -> tuple[float, float]:
        return self.x

    def closed_extent(self) -> float:
        return self.pair.v + self.t1 + self.t3

    @classmethod
    def recognise(cls, members: Members) -> Recognition:
        ground, backdrop = members.on_base(0), members.on_base(1)
        ridge = members.between(ground[0][0], backdrop[0][0]) if len(ground) == len(backdrop) == 1 else None
        if ridge is None or len(members.record.patches) != 2:
            form = "one patch hinged to each base patch, and a fold between them"
            return Recognition.unlike(members.id, form)
        first, second = members.section(ground[0][1]), members.section(backdrop[0][1])
        top = members.section(ridge)
        slopes = [float(np.linalg.norm(top - foot)) for foot in (first, second)]
        conditions = (
            identity("foldable", members.id, "|T1| = |T2|", first[0] - second[0]),
            identity("foldable", members.id, "|T3| = |T4|", slopes[0] - slopes[1]),
            identity("foldable", members.id, "ridge in the bisecting plane", top[0]),
            Condition("foldable", members.id, "|T3| > |T1|", slopes[0] - float(first[0])),
        )
        if not (first[0] > 0 and top[1] > 0):
            return Recognition(None, conditions)
        tent = cls(members.id, members.pair, members.extent_x(), float(first[0]), float(top[1]))
        return Recognition(tent, conditions, {ground[0][0]: "T_3", backdrop[0][0]: "T_4"})

    @classmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator["TentFold"]:
        if not isinstance(primitive, TriangularPrism) or primitive.edges != "x" or pair.kind is not cls.pair_kind:
            return
        t1 = min(-primitive.low[1], primitive.high[1])
        x, height = (primitive.low[0], primitive.high[0]), primitive.high[2] - pair.v
        if pair.x[0] <= x[0] and x[1] <= pair.x[1] and 0 < t1 <= min(pair.reach) and height > 0:
            yield cls(id, pair, x, t1, height)

    def primitive(self) -> Primitive:
        (x0, x1), v = self.x, self.pair.v
        return TriangularPrism((x0, -self.t1, v), (x1, self.t1, v + self.height), "x")

    @classmethod
    def random(cls, rng: Generator, pair: BasePatchPair, id: str, room: Room) -> "TentFold | None":
        low, high = room.within(*pair.x).x
        left = room.extent - pair.v
        most = min(*pair.reach, left / 3)
        if high - low < LEAST or most < LEAST:
            return None
        x = draw_interval(rng, low, high)
        t1 = draw(rng, LEAST, most)
        return cls(id, pair, x, t1, draw(rng, t1 / 4, float(np.sqrt((left - t1) ** 2 - t1**2))))

    def faults(self) -> tuple[Fault, ...]:
        foot = np.array([[x, -self.t1, self.pair.v] for x in self.x])
        return (Fault("|T1| = |T2|", ("T_4",), foot, np.array([0.0, 1.0, 0.0]), self.t1 / 2),)


Z_ROW = np.array([[0.0, 0.0, 1.0]])
_SLOPES = ((Side.GROUND, "T_3"), (Side.BACKDROP, "T_4"))

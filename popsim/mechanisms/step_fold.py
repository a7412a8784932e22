"""Step-fold: a riser and a tread that make a parallelogram with a corner pair (Sec. 3.2.1, Fig. 5a)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import MINUS_Y, X_AXIS, Y_AXIS, Z_AXIS, Side, page_direction, skew_point
from popsim.geometry.rigid import Frame
from popsim.mechanisms.base import Mechanism, Recognition, require_positive
from popsim.mechanisms.condition import identity
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
from popsim.mechanisms.primitive import Primitive, RectangularPrism
from popsim.mechanisms.room import LEAST, Room, draw, draw_interval

PARAPET = 0.4
"""Depths by which a riser may rise above its tread; it keeps its place, as all of a step does."""

TREAD_DEPTH = 0.75
"""Share of the height down to which the model shows on a tread."""


@dataclass(frozen=True)
class StepFold(Mechanism):
    """A step over x in a corner: depth s along the floor, height h along the wall.

    The riser (S_4 of the paper) stays parallel to the wall, the tread (S_3) to the floor; it pops up where the
    corner opens to 90 degrees, which it does when the card is open. It does not move along x.
    """

    x: tuple[float, float]
    s: float
    h: float

    type = "step-fold"
    pair_kind = PairKind.CORNER

    def _check_parameters(self) -> None:
        require_positive(self, length=self.x[1] - self.x[0], s=self.s, h=self.h)

    def plates(self) -> tuple[Plate, ...]:
        wall, foot, edge = self._section()
        outward = Y_AXIS if self.pair.side is Side.GROUND else MINUS_Y
        rise = min(PARAPET * self.s, self.pair.reach[1] - self.h)
        room = rectangle(self.x, foot, (edge[0], edge[1] + max(rise, 0.0)))
        return plates_from(
            [
                Face("riser", rectangle(self.x, foot, edge), outward, room=room, behind=self.s),
                Face("tread", rectangle(self.x, wall, edge), Z_AXIS, behind=TREAD_DEPTH * self.h),
            ]
        )

    def joints(self) -> tuple[Joint, ...]:
        x0, x1 = self.x
        wall, foot, edge = self._section()
        return joints_from(
            [
                Line((FIRST_BASE, "riser"), (x0, *foot), (x1, *foot), "glue"),
                Line((SECOND_BASE, "tread"), (x0, *wall), (x1, *wall), "glue"),
                Line(("riser", "tread"), (x0, *edge), (x1, *edge), "fold"),
            ]
        )

    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        pair = self.pair
        d = page_direction(pair.side, theta)
        along = np.broadcast_to(X_AXIS, d.shape)
        return {
            "riser": Frame(skew_point(0, pair.u + self.s, pair.v, pair.side, theta), along, 0 * d + Z_AXIS),
            "tread": Frame(skew_point(0, pair.u, pair.v + self.h, pair.side, theta), along, d),
        }

    def pairs(self) -> tuple[BasePatchPair, ...]:
        pair = self.pair
        riser, tread = self.patch_id("riser"), self.patch_id("tread")

        def corner(patches: tuple[str, str], u: float, v: float, reach: tuple[float, float]) -> BasePatchPair:
            return BasePatchPair(patches, PairKind.CORNER, pair.side, u, v, self.x, reach, owner=self.id)

        outer = corner((pair.patches[0], riser), pair.u + self.s, pair.v, (pair.reach[0] - self.s, self.h))
        upper = corner((tread, pair.patches[1]), pair.u, pair.v + self.h, (self.s, pair.reach[1] - self.h))
        return tuple(offered for offered in (outer, upper) if min(offered.reach) > 0)

    def closing_range(self) -> tuple[float, float]:
        return self.x

    def closed_extent(self) -> float:
        return self.pair.u + self.s + self.pair.v + self.h

    @classmethod
    def recognise(cls, members: Members) -> Recognition:
        feet, heads = members.on_base(0), members.on_base(1)
        edge = members.between(feet[0][0], heads[0][0]) if len(feet) == len(heads) == 1 else None
        if edge is None or len(members.record.patches) != 2:
            form = "one patch hinged to the floor, one to the wall, and a fold between them"
            return Recognition.unlike(members.id, form)
        foot, head, top = (members.section(hinge) for hinge in (feet[0][1], heads[0][1], edge))
        floor, wall = foot[0], head[1]
        riser, tread = float(np.linalg.norm(top - foot)), float(np.linalg.norm(top - head))
        conditions = (
            identity("foldable", members.id, "|S1| = |S3| (floor and tread)", floor - tread),
            identity("foldable", members.id, "|S2| = |S4| (wall and riser)", wall - riser),
        )
        if not (floor > 0 and wall > 0):
            return Recognition(None, conditions)
        step = cls(members.id, members.pair, members.extent_x(), float(floor), float(wall))
        return Recognition(step, conditions, {feet[0][0]: "riser", heads[0][0]: "tread"})

    @classmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator["StepFold"]:
        if not isinstance(primitive, RectangularPrism) or primitive.turned or pair.kind is not cls.pair_kind:
            return
        near, far = sorted(pair.side.value * y for y in (primitive.low[1], primitive.high[1]))
        s, h = far - pair.u, primitive.high[2] - pair.v
        x = (primitive.low[0], primitive.high[0])
        fits = pair.x[0] <= x[0] and x[1] <= pair.x[1] and 0 < s <= pair.reach[0] and 0 < h <= pair.reach[1]
        if fits and near <= pair.u + 1e-6 and primitive.low[2] <= pair.v + 1e-6:
            yield cls(id, pair, x, s, h)

    def primitive(self) -> Primitive:
        pair, (x0, x1) = self.pair, self.x
        near, far = sorted((pair.side.value * pair.u, pair.side.value * (pair.u + self.s)))
        return RectangularPrism((x0, near, pair.v), (x1, far, pair.v + self.h))

    @classmethod
    def random(cls, rng: Generator, pair: BasePatchPair, id: str, room: Room) -> "StepFold | None":
        low, high = room.within(*pair.x).x
        left = room.extent - pair.u - pair.v
        deep, tall = min(pair.reach[0], left - LEAST), min(pair.reach[1], left - LEAST)
        if high - low < LEAST or deep < LEAST or tall < LEAST:
            return None
        x = draw_interval(rng, low, high)
        s = draw(rng, LEAST, deep)
        return cls(id, pair, x, s, draw(rng, LEAST, min(tall, left - s)))

    def faults(self) -> tuple[Fault, ...]:
        wall, _, _ = self._section()
        head = np.array([[x, *wall] for x in self.x])
        return (Fault("|S2| = |S4|", ("tread",), head, -Z_AXIS, self.h / 2),)

    def _section(self) -> tuple[tuple[float, float], ...]:
        """Hinge on the wall, hinge on the floor and common fold, open pose, each as (y, z)."""
        pair = self.pair
        near, far = (pair.side.value * u for u in (pair.u, pair.u + self.s))
        return (near, pair.v + self.h), (far, pair.v), (far, pair.v + self.h)

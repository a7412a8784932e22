"""Box-fold: sides, backbone and tops of a box, kept from shearing by front and back pairs (Sec. 3.2.4, Fig. 6)."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple, Self

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import MINUS_X, MINUS_Y, MINUS_Z, X_AXIS, Y_AXIS, Z_AXIS, Side, page_direction
from popsim.geometry.rigid import Frame
from popsim.mechanisms.base import Mechanism, Recognition, require_positive
from popsim.mechanisms.box_fold_contours import (
    FIN_DEPTH,
    backbone_room,
    end_depth,
    end_room,
    side_room,
    top_depth,
    top_room,
)
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind
from popsim.mechanisms.plate import (
    FIRST_BASE,
    SECOND_BASE,
    Face,
    Joint,
    Kind,
    Line,
    Plate,
    Point,
    joints_from,
    plates_from,
    rectangle,
)
from popsim.mechanisms.primitive import Primitive, PrismRow, RectangularPrism
from popsim.mechanisms.room import Room


class Top(NamedTuple):
    """A top over [x0, x1] at `height` above the fold line, mm."""

    x0: float
    x1: float
    height: float


class EndPair(NamedTuple):
    """A front pair (facing 1) or back pair (facing -1) at x, from `low` to `high` above the fold line, mm."""

    x: float
    low: float
    high: float
    facing: Literal[1, -1]


@dataclass(frozen=True)
class BoxFold(Mechanism):
    """A box of half width w over an opening pair, with one or several tops and end pairs (layers, Sec. 4.3).

    `tops` adjoin each other from back to front; sides L, R and backbone C carry their profile. While closing, the
    sides stand on w g and w b, the tops keep parallel to the pages at their height, and each end pair moves
    outward by w cos a, lifted by w cos a.
    """

    half_width: float
    tops: tuple[Top, ...]
    end_pairs: tuple[EndPair, ...]

    type = "box-fold"
    pair_kind = PairKind.OPENING

    @classmethod
    def stepped(cls, id: str, pair: BasePatchPair, half_width: float, tops: tuple[Top, ...]) -> Self:
        """The box-fold under a profile, with an end pair at each of its steps and ends."""
        return cls(id, pair, half_width, tops, step_pairs(tops))

    @classmethod
    def plain(cls, id: str, pair: BasePatchPair, half_width: float, height: float, x: tuple[float, float]) -> Self:
        """The simple box of Fig. 6."""
        return cls.stepped(id, pair, half_width, (Top(*x, height),))

    def _check_parameters(self) -> None:
        require_positive(self, half_width=self.half_width)
        if not self.tops:
            raise GeometryError(f"{self.id}: a box-fold needs at least one top")
        for top in self.tops:
            require_positive(self, length=top.x1 - top.x0, height=top.height)
        for left, right in pairwise(self.tops):
            if abs(left.x1 - right.x0) > 1e-9 or left.height == right.height:
                raise GeometryError(
                    f"{self.id}: tops of a box-fold adjoin at different heights, not {left} next to {right}"
                )
        for end in self.end_pairs:
            require_positive(self, pair_height=end.high - end.low)

    @property
    def x(self) -> tuple[float, float]:
        """Extent of sides and tops along x."""
        return self.tops[0].x0, self.tops[-1].x1

    @property
    def height(self) -> float:
        """Height of the highest top above the fold line."""
        return max(top.height for top in self.tops)

    def profile(self, y: float) -> list[Point]:
        """Corners of a side or the backbone in the plane y, open pose."""
        v = self.pair.v
        corners = [(self.x[0], y, v), (self.x[1], y, v)]
        for top in reversed(self.tops):
            corners += [(top.x1, y, v + top.height), (top.x0, y, v + top.height)]
        return corners

    def plates(self) -> tuple[Plate, ...]:
        w, v = self.half_width, self.pair.v
        faces = [
            Face("L", self.profile(w), Y_AXIS, room=side_room(self, w), behind=w),
            Face("R", self.profile(-w), MINUS_Y, room=side_room(self, -w), behind=w),
            Face("C", self.profile(0.0), Y_AXIS, principal=False, room=backbone_room(self), beside=FIN_DEPTH * w),
        ]
        for top, roles in zip(self.tops, self.top_roles(), strict=True):
            z, depth = v + top.height, top_depth(self, top)
            for role, sign in zip(roles, (1, -1), strict=True):
                outline = rectangle((top.x0, top.x1), (0.0, z), (sign * w, z))
                faces.append(Face(role, outline, Z_AXIS, room=top_room(self, top, sign), behind=depth))
        for end, roles in zip(self.end_pairs, self.end_roles(), strict=True):
            outward, depth = X_AXIS if end.facing == 1 else MINUS_X, end_depth(self, end)
            for role, sign in zip(roles, (1, -1), strict=True):
                corners = ((sign * w, end.low), (0.0, end.low), (0.0, end.high), (sign * w, end.high))
                outline = [(end.x, y, v + z) for y, z in corners]
                faces.append(Face(role, outline, outward, room=end_room(self, end, sign), behind=depth))
        return plates_from(faces)

    def joints(self) -> tuple[Joint, ...]:
        w, v = self.half_width, self.pair.v

        def level(
            roles: tuple[str, str],
            x: tuple[float, float],
            y: float,
            z: float,
            kind: Kind,
            crease: FloatArray | None = None,
        ) -> Line:
            return Line(roles, (x[0], y, v + z), (x[1], y, v + z), kind, crease)

        def upright(roles: tuple[str, str], end: EndPair, y: float, crease: FloatArray | None = None) -> Line:
            return Line(roles, (end.x, y, v + end.low), (end.x, y, v + end.high), "fold", crease)

        lines = [
            level((FIRST_BASE, "L"), self.x, w, 0.0, "glue"),
            level((SECOND_BASE, "R"), self.x, -w, 0.0, "glue"),
            level((FIRST_BASE, "C"), self.x, 0.0, 0.0, "glue"),
        ]
        for top, (ground, backdrop) in zip(self.tops, self.top_roles(), strict=True):
            x = top.x0, top.x1
            lines += [
                level(("L", ground), x, w, top.height, "fold"),
                level(("R", backdrop), x, -w, top.height, "fold"),
                level((ground, backdrop), x, 0.0, top.height, "fold", MINUS_Z),
                level((ground, "C"), x, 0.0, top.height, "glue"),
            ]
        for end, (left, right) in zip(self.end_pairs, self.end_roles(), strict=True):
            outward = X_AXIS if end.facing == 1 else MINUS_X
            lines += [
                upright(("L", left), end, w),
                upright(("R", right), end, -w),
                upright((left, right), end, 0.0, outward),
            ]
        return joints_from(lines)

    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        alpha = np.asarray(theta, float) / 2
        zero = np.zeros((len(alpha), 3))
        along, up = zero + X_AXIS, zero + Z_AXIS
        frames = {"C": Frame(zero, along, up)}
        out = {side: page_direction(side, theta) for side in Side}
        for side, role in ((Side.GROUND, "L"), (Side.BACKDROP, "R")):
            frames[role] = Frame(self.half_width * out[side], along, up)
        for top, roles in zip(self.tops, self.top_roles(), strict=True):
            fold = zero + (self.pair.v + top.height) * Z_AXIS
            for side, role in zip(Side, roles, strict=True):
                frames[role] = Frame(fold, along, out[side])
        for end, roles in zip(self.end_pairs, self.end_roles(), strict=True):
            for side, role in zip(Side, roles, strict=True):
                hinge = self.half_width * out[side] + end.x * X_AXIS
                inward = np.stack([end.facing * np.cos(alpha), -side.value * np.sin(alpha), 0 * alpha], axis=-1)
                frames[role] = Frame(hinge, inward, up)
        return frames

    def pairs(self) -> tuple[BasePatchPair, ...]:
        offered = []
        for top, roles in zip(self.tops, self.top_roles(), strict=True):
            offered.append(self._top_pair(top, roles))
            offered += self._corner_pairs(top)
        return tuple(offered)

    def closing_range(self) -> tuple[float, float]:
        reached = [end.x + end.facing * self.half_width for end in self.end_pairs]
        return min([self.x[0], *reached]), max([self.x[1], *reached])

    def closed_extent(self) -> float:
        return self.pair.v + self.half_width + max([self.height, *(end.high for end in self.end_pairs)])

    def parameters(self) -> dict[str, Any]:
        return {
            "half_width": self.half_width,
            "tops": [dict(top._asdict()) for top in self.tops],
            "end_pairs": [dict(end._asdict()) for end in self.end_pairs],
        }

    @classmethod
    def recognise(cls, members: Members) -> Recognition:
        from popsim.mechanisms.box_fold_parts import recognise_box

        return recognise_box(cls, members)

    @classmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator[Self]:
        if pair.kind is not cls.pair_kind:
            return
        if isinstance(primitive, RectangularPrism) and not primitive.turned:
            half = min(-primitive.low[1], primitive.high[1])
            tops: tuple[Top, ...] = (Top(primitive.low[0], primitive.high[0], primitive.high[2] - pair.v),)
        elif isinstance(primitive, PrismRow):
            half, lift = primitive.half_width, primitive.base - pair.v
            tops = tuple(Top(x0, x1, height + lift) for x0, x1, height in primitive.tops)
        else:
            return
        within = pair.x[0] <= tops[0].x0 and tops[-1].x1 <= pair.x[1] and 0 < half <= min(pair.reach)
        if within and min(top.height for top in tops) > 0:
            yield cls.stepped(id, pair, half, tops)

    @classmethod
    def derived(cls, known: Mapping[str, Any]) -> dict[str, Any]:
        return {"end_pairs": step_pairs(known["tops"])} if "tops" in known else {}

    def primitive(self) -> Primitive:
        return PrismRow(self.half_width, self.pair.v, tuple((top.x0, top.x1, top.height) for top in self.tops))

    @classmethod
    def random(cls, rng: Generator, pair: BasePatchPair, id: str, room: Room) -> Self | None:
        from popsim.mechanisms.box_fold_random import random_box

        return random_box(cls, rng, pair, id, room)

    def faults(self) -> tuple[Fault, ...]:
        from popsim.mechanisms.box_fold_random import ridge_faults

        return ridge_faults(self)

    def top_roles(self) -> list[tuple[str, str]]:
        """Roles of the ground and backdrop halves of each top."""
        return [(f"T_G{_number(k)}", f"T_B{_number(k)}") for k in range(len(self.tops))]

    def end_roles(self) -> list[tuple[str, str]]:
        """Roles of the left and right patches of each end pair."""
        seen = {1: 0, -1: 0}
        roles = []
        for end in self.end_pairs:
            letter, number = "F" if end.facing == 1 else "B", _number(seen[end.facing])
            seen[end.facing] += 1
            roles.append((f"{letter}_L{number}", f"{letter}_R{number}"))
        return roles

    def _top_pair(self, top: Top, roles: tuple[str, str]) -> BasePatchPair:
        """The top as a card again; higher tops, and end pairs that sweep over it, narrow what is free."""
        higher = [other for other in self.tops if other.height > top.height]
        low = max((other.x1 for other in higher if other.x1 <= top.x0), default=-np.inf)
        high = min((other.x0 for other in higher if other.x0 >= top.x1), default=np.inf)
        for end in self.end_pairs:
            if end.high > top.height + 1e-9:
                if end.facing == 1 and end.x <= top.x0 + 1e-9:
                    low = max(low, end.x + self.half_width)
                elif end.facing == -1 and end.x >= top.x1 - 1e-9:
                    high = min(high, end.x - self.half_width)
        return BasePatchPair(
            patches=(self.patch_id(roles[0]), self.patch_id(roles[1])),
            kind=PairKind.OPENING,
            side=Side.GROUND,
            u=0.0,
            v=self.pair.v + top.height,
            x=(top.x0, top.x1),
            reach=(self.half_width, self.half_width),
            free=(low, high),
            owner=self.id,
        )

    def _corner_pairs(self, top: Top) -> list[BasePatchPair]:
        corners = []
        for side, wall, base in ((Side.GROUND, "L", 0), (Side.BACKDROP, "R", 1)):
            floor = self.pair.reach[base] - self.half_width
            if floor > 0:
                patches = (self.pair.patches[base], self.patch_id(wall))
                corners.append(
                    BasePatchPair(
                        patches=patches,
                        kind=PairKind.CORNER,
                        side=side,
                        u=self.half_width,
                        v=self.pair.v,
                        x=(top.x0, top.x1),
                        reach=(floor, top.height),
                        owner=self.id,
                    )
                )
        return corners


def step_pairs(tops: tuple[Top, ...]) -> tuple[EndPair, ...]:
    """An end pair at each step and end of a profile: a back pair where it rises with x, else a front pair."""
    levels = [(tops[0].x0, 0.0, tops[0].height)]
    levels += [(right.x0, left.height, right.height) for left, right in pairwise(tops)]
    levels.append((tops[-1].x1, tops[-1].height, 0.0))
    return tuple(EndPair(x, min(a, b), max(a, b), 1 if b < a else -1) for x, a, b in levels)


def _number(index: int) -> str:
    """Suffix of the roles of a layer: none for the first."""
    return str(index + 1) if index else ""

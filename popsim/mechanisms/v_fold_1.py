"""V-fold of the first type: a whole box standing on a corner (Sec. 3.2.3, Fig. 5c)."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import Frame
from popsim.mechanisms.condition import identity
from popsim.mechanisms.members import Members, along_z
from popsim.mechanisms.pair import BasePatchPair
from popsim.mechanisms.plate import Face, Line
from popsim.mechanisms.primitive import Primitive, RectangularPrism
from popsim.mechanisms.v_fold import SIDES, VFold, diagonal
from popsim.mechanisms.v_fold_parts import Part, Walls


@dataclass(frozen=True)
class VFold1(VFold):
    """Front walls, roof, and back walls B_L, B_R that complete a rhombus ring of four parallel folds.

    The back walls are glued neither to the base nor to the roof: closing, the back corner rises by
    sqrt2 width cos a.
    """

    type = "v-fold-1"
    depth = float(np.sqrt(2))

    def _faces(self) -> list[Face]:
        end = self.end
        backs = []
        for side, letter, _ in SIDES:
            corner = self.corner(side)
            face = [corner, end, self._risen(end), self._risen(corner)]
            backs.append(Face(f"B_{letter}", face, diagonal(-self.facing, side.value), behind=self.width))
        return super()._faces() + backs

    def _lines(self) -> list[Line]:
        end = self.end
        sides = []
        for side, letter, _ in SIDES:
            corner = self.corner(side)
            sides.append(Line((f"F_{letter}", f"B_{letter}"), corner, self._risen(corner), "fold"))
        return [*super()._lines(), *sides, Line(("B_L", "B_R"), end, self._risen(end), "fold")]

    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        edge = self.edge_direction(theta)
        backs = {}
        for side, letter, _ in SIDES:
            corner = self.foot + self.width * self.wall_direction(side, theta)
            backs[f"B_{letter}"] = Frame(corner, self.wall_direction(side.other, theta), edge)
        return super().frames(theta) | backs

    def closed_extent(self) -> float:
        back, ends = np.sqrt(2) * self.width + self.height / np.sqrt(2), (self.width + self.height) / np.sqrt(2)
        return self.pair.v + float(max(back, ends))

    def find_rest(self, members: Members, walls: Walls) -> tuple[Self, list[Part]] | str:
        backs, corners = [], []
        for wall in (walls.left, walls.right):
            found = [
                (name, hinge)
                for name, hinge in members.neighbours(wall)
                if along_z(hinge) and name not in (walls.left, walls.right)
            ]
            if len(found) != 1:
                return "a back wall folded to each front wall"
            backs.append(found[0][0])
            corners.append(found[0][1].points.mean(axis=0))
        ring = members.between(*backs)
        if ring is None or not along_z(ring):
            return "an upright fold between the back walls"
        end = ring.points.mean(axis=0)
        tip = np.array([walls.tip, 0.0, 0.0])
        fronts = [float(np.linalg.norm((corner - tip)[:2])) for corner in corners]
        rears = [float(np.linalg.norm((corner - end)[:2])) for corner in corners]
        offs = [
            float(line_distance(np.array([corner[0], corner[1], axis[0, 2]]), axis))
            for corner, axis in zip(corners, walls.axes, strict=True)
        ]
        conditions = (
            identity("foldable", members.id, "|F_L| = |F_R|", fronts[0] - fronts[1]),
            identity("foldable", members.id, "|B_L| = |F_R|", rears[0] - fronts[1]),
            identity("foldable", members.id, "|B_R| = |F_L|", rears[1] - fronts[0]),
            identity("foldable", members.id, "back fold in the bisecting plane", float(end[1])),
            *(identity("foldable", members.id, "side fold over its base hinge", off) for off in offs),
        )
        part = Part(dict(zip(backs, ("B_L", "B_R"), strict=True)), conditions)
        return replace(self, width=fronts[0]), [part]

    @classmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator[Self]:
        if isinstance(primitive, RectangularPrism) and primitive.turned:
            yield from cls._from_box(primitive, pair, id, (1, -1))

    def primitive(self) -> Primitive:
        return RectangularPrism(*self._box(), turned=True)

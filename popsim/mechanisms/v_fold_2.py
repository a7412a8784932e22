"""V-fold of the second type: the triangular front half of a box on its corner (Sec. 3.2.3, Fig. 5d)."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np

from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair
from popsim.mechanisms.primitive import Primitive, TriangularPrism
from popsim.mechanisms.v_fold import VFold
from popsim.mechanisms.v_fold_parts import Part, Walls


@dataclass(frozen=True)
class VFold2(VFold):
    """Front walls and roof only; it is open at the back."""

    type = "v-fold-2"
    depth = float(1 / np.sqrt(2))

    def closed_extent(self) -> float:
        return self.pair.v + float((self.width + self.height) / np.sqrt(2))

    def find_rest(self, members: Members, walls: Walls) -> tuple[Self, list[Part]] | str:
        return self, []

    @classmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator[Self]:
        if isinstance(primitive, TriangularPrism) and primitive.edges == "z":
            yield from cls._from_box(primitive, pair, id, (primitive.facing,))

    def primitive(self) -> Primitive:
        return TriangularPrism(*self._box(), "z", self.facing)

"""Small changes of an abstraction: a prism less, a border moved, a step of a profile merged or cut."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

from popsim.errors import GeometryError
from popsim.fitting.candidate import Candidate
from popsim.fitting.knobs import Knob, knobs, limited, merged, turned
from popsim.mechanisms import Primitive, PrismRow

SAME = 1e-6
"""mm; a border that moves by less does not move."""

Snap = Callable[[float, int], float]
"""Where a border goes that was moved to a position (mm) on an axis (0 x, 1 distance from the fold, 2 height)."""


@dataclass(frozen=True)
class Move(ABC):
    """A change of one node, by its index; `steps` tells whether it depends on a step."""

    index: int
    steps: ClassVar[bool] = True

    @abstractmethod
    def made(self, state: Candidate, step: float, snap: Snap) -> Candidate | None:
        """The candidate after a change by `step` mm, or None where it cannot be made."""


@dataclass(frozen=True)
class Remove(Move):
    """Take a node away, and what stands on it."""

    steps = False

    def made(self, state: Candidate, step: float, snap: Snap) -> Candidate | None:
        fewer = state.without(self.index)
        return fewer if fewer is not None and fewer.nodes else None


@dataclass(frozen=True)
class Turn(Move):
    """Move the border of a knob."""

    knob: int
    sign: Literal[1, -1]

    def made(self, state: Candidate, step: float, snap: Snap) -> Candidate | None:
        node = state.nodes[self.index]
        own = knobs(node.primitive)
        axis, at = own[self.knob]
        target: Knob = (axis, snap(at + self.sign * step, axis))
        values = [value for _, value in own]
        values[self.knob] = limited(target, node.pair)
        if abs(values[self.knob] - at) < SAME:
            return None
        return _changed(state, self.index, lambda: turned(node.primitive, values))


@dataclass(frozen=True)
class Merge(Move):
    """Give two neighbouring tops of a row the height of one of them."""

    border: int
    keep: Literal[0, 1]
    steps = False

    def made(self, state: Candidate, step: float, snap: Snap) -> Candidate | None:
        row = state.nodes[self.index].primitive
        if not isinstance(row, PrismRow):
            return None
        left, right = row.tops[self.border : self.border + 2]
        joined = (left[0], right[1], (left, right)[self.keep][2])
        tops = [*row.tops[: self.border], joined, *row.tops[self.border + 2 :]]
        return _changed(state, self.index, lambda: PrismRow(row.half_width, row.base, merged(tops)))


@dataclass(frozen=True)
class Cut(Move):
    """Cut a step into the first or last top of a row."""

    end: Literal[0, -1]

    def made(self, state: Candidate, step: float, snap: Snap) -> Candidate | None:
        row = state.nodes[self.index].primitive
        if not isinstance(row, PrismRow):
            return None
        x0, x1, height = row.tops[self.end]
        if min(x1 - x0, height) <= 2 * step:
            return None
        if self.end == 0:
            tops = [(x0, x0 + step, height - step), (x0 + step, x1, height), *row.tops[1:]]
        else:
            tops = [*row.tops[:-1], (x0, x1 - step, height), (x1 - step, x1, height - step)]
        return _changed(state, self.index, lambda: PrismRow(row.half_width, row.base, merged(tops)))


def moves(state: Candidate) -> list[Move]:
    """All changes of a state, those of what stands on others first."""
    found: list[Move] = []
    for index in reversed(range(len(state.nodes))):
        primitive = state.nodes[index].primitive
        found.append(Remove(index))
        found += [Turn(index, knob, sign) for knob in range(len(knobs(primitive))) for sign in (1, -1)]
        if isinstance(primitive, PrismRow):
            borders = range(len(list(pairwise(primitive.tops))))
            found += [Merge(index, border, keep) for border in borders for keep in (0, 1)]
            found += [Cut(index, 0), Cut(index, -1)]
    return found


def _changed(state: Candidate, index: int, make: Callable[[], Primitive]) -> Candidate | None:
    try:
        return state.with_primitive(index, make())
    except GeometryError:
        return None

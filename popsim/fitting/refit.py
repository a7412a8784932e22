"""Turning the knobs of an abstraction while it comes to look more like its model."""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise

from popsim.errors import GeometryError
from popsim.fitting.candidate import Candidate
from popsim.fitting.greedy import Grower
from popsim.fitting.knobs import knobs, limited, merged, turned
from popsim.fitting.snap import Planes
from popsim.mechanisms import Primitive, PrismRow

STEPS = (4.0, 1.5, 0.6)
"""Cells by which knobs are turned, in turn."""

NEAR = 0.35
"""Cells within which a turned knob goes to a plane of the model."""

Value = Callable[[Candidate], float]


ADDITIONS = 3
"""Prisms that may be added after the first refitting."""

BETTER = 1e-5
"""Least gain that counts; below is noise of the pixels."""


class Climber:
    """Climbs to candidates of greater value; every step keeps all conditions of the theory."""

    def __init__(self, value: Value, grower: Grower) -> None:
        self.value, self.grower = value, grower
        self.cell = grower.volume.cell

    def climb(self, start: Candidate, budget: int) -> Candidate:
        """Refit, then add prisms and refit again, with at most `budget` evaluations for refitting."""
        state = self._refitted(start, budget // 2)
        for _ in range(ADDITIONS):
            more = self._added(state)
            if more is None:
                break
            state = more
        return self._refitted(state, budget - budget // 2)

    def _added(self, state: Candidate) -> Candidate | None:
        """The best valid state with one more prism, if it is better."""
        least = self.value(state) + BETTER
        better = [(found, more) for more in self.grower.additions(state) if (found := self.value(more)) > least]
        ranked = sorted(better, key=lambda entry: -entry[0])
        return next((more for _, more in ranked if more.holds()), None)

    def _refitted(self, state: Candidate, budget: int) -> Candidate:
        """First improvements among the neighbours, in coarse steps first."""
        score = self.value(state)
        for step in STEPS:
            improved = True
            while improved and budget > 0:
                improved = False
                for changed in _neighbours(state, self.grower.planes, step * self.cell, self.cell):
                    budget -= 1
                    found = self.value(changed)
                    if found > score + BETTER and changed.holds():
                        state, score, improved = changed, found, True
                    if improved or budget <= 0:
                        break
        return state


def _neighbours(state: Candidate, planes: Planes, step: float, cell: float) -> Iterator[Candidate]:
    """Candidates that differ in one place: a node less, a knob turned, a top merged or split."""
    for index in reversed(range(len(state.nodes))):
        if len(state.nodes) > 1 and (fewer := state.without(index)) is not None and fewer.nodes:
            yield fewer
        node = state.nodes[index]
        own = knobs(node.primitive)
        for position, (axis, at) in enumerate(own):
            for target in (at + step, at - step):
                moved = limited((axis, planes.snap(target, axis, NEAR * cell)), node.pair)
                if abs(moved - at) < 1e-6:
                    continue
                values = [v for _, v in own]
                values[position] = moved
                yield from _changed(state, index, partial(turned, node.primitive, values))
        if isinstance(node.primitive, PrismRow):
            for tops in _other_profiles(node.primitive, step):
                yield from _changed(state, index, partial(_reprofiled, node.primitive, tops))


def _changed(state: Candidate, index: int, make: Callable[[], Primitive]) -> Iterator[Candidate]:
    try:
        changed = state.with_primitive(index, make())
    except GeometryError:
        return
    if changed is not None:
        yield changed


def _reprofiled(row: PrismRow, tops: list[tuple[float, float, float]]) -> PrismRow:
    return PrismRow(row.half_width, row.base, merged(tops))


def _other_profiles(row: PrismRow, step: float) -> Iterator[list[tuple[float, float, float]]]:
    """Profiles of a row with a step less, or with one more at an end."""
    tops = list(row.tops)
    for k, (left, right) in enumerate(pairwise(tops)):
        for height in (left[2], right[2]):
            yield [*tops[:k], (left[0], right[1], height), *tops[k + 2 :]]
    first, last = tops[0], tops[-1]
    if first[1] - first[0] > 2 * step and first[2] > 2 * step:
        yield [(first[0], first[0] + step, first[2] - step), (first[0] + step, *first[1:]), *tops[1:]]
    if last[1] - last[0] > 2 * step and last[2] > 2 * step:
        yield [*tops[:-1], (last[0], last[1] - step, last[2]), (last[1] - step, last[1], last[2] - step)]

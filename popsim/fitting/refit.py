"""Climbing from an abstraction to one that looks more like its model."""

from collections.abc import Callable, Sequence

from popsim.fitting.candidate import Candidate
from popsim.fitting.greedy import Grower
from popsim.fitting.moves import moves

STEPS = (4.0, 1.5, 0.6)
"""Cells by which borders are moved, in turn."""

NEAR = 0.35
"""Cells within which a moved border goes to a plane of the model."""

ADDITIONS = 4
"""Prisms that may be added after the first refitting."""

BETTER = 2e-4
"""Least gain that counts; below is noise of the pixels."""

Value = Callable[[Candidate], float]


class Climber:
    """Climbs to candidates of greater value; every step keeps all conditions of the theory."""

    def __init__(self, value: Value, grower: Grower) -> None:
        self.value, self.grower = value, grower

    def complete(self, start: Candidate, budget: int) -> Candidate:
        """Add prisms while that is better, and refit, with at most `budget` evaluations for refitting."""
        state = start
        for _ in range(ADDITIONS):
            more = self._added(state)
            if more is None:
                break
            state = self.refit(more, budget // (2 * ADDITIONS))
        return self.refit(state, budget // 2)

    def refit(self, state: Candidate, budget: int, steps: Sequence[float] = STEPS) -> Candidate:
        """Make changes that improve, in coarse steps (cells) first, with at most `budget` evaluations.

        Changes are tried in turn, all round; one that improves is tried again at once.
        """
        score = self.value(state)
        for step in steps:
            ways = moves(state)
            idle = position = 0
            while idle < len(ways) and budget > 0:
                changed = ways[position % len(ways)].made(state, step * self.grower.volume.cell, self._snapped)
                position, idle = position + 1, idle + 1
                if changed is None:
                    continue
                budget -= 1
                found = self.value(changed)
                if found > score + BETTER and changed.holds():
                    state, score, idle = changed, found, 0
                    ways, before = moves(state), len(ways)
                    position = position - 1 if len(ways) == before else 0
        return state

    def _added(self, state: Candidate) -> Candidate | None:
        """The best valid state with one more prism, if it is better."""
        least = self.value(state) + BETTER
        better = [(found, more) for more in self.grower.additions(state) if (found := self.value(more)) > least]
        ranked = sorted(better, key=lambda entry: -entry[0])
        return next((more for _, more in ranked if more.holds()), None)

    def _snapped(self, position: float, axis: int) -> float:
        """A position on an axis, or the plane of the model near it."""
        return self.grower.planes.snap(position, axis, NEAR * self.grower.volume.cell)

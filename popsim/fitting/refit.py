"""Climbing from an abstraction to one that looks more like its model."""

from collections.abc import Callable, Sequence

from popsim.fitting.candidate import Candidate
from popsim.fitting.greedy import Grower
from popsim.fitting.known import Known
from popsim.fitting.moves import Move, moves

STEPS = (4.0, 1.5, 0.6)
"""Cells by which borders are moved, in turn."""

NEAR = 0.35
"""Cells within which a moved border goes to a plane of the model."""

ADDITIONS = 4
"""Prisms that may be added after the first refitting."""

BETTER = 2e-4
"""Least gain that counts; below is noise of the pixels."""

Value = Known[Candidate, float]


def valued(work: Callable[[Candidate], float]) -> Value:
    """What candidates are worth, where those that look alike are worth the same."""
    return Known(work, lambda candidate: (candidate.mechanisms, tuple(sorted(candidate.depths.items()))))


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
            position = 0
            while budget > 0:
                ways = moves(state)
                tries, better = self._better(state, ways[position:] + ways[:position], step, score, budget)
                budget -= tries
                if better is None:
                    break
                taken, state, score = better
                same = len(moves(state)) == len(ways)
                position = (position + taken) % len(ways) if same else 0
        return state

    def _better(
        self, state: Candidate, ways: Sequence[Move], step: float, score: float, budget: int
    ) -> tuple[int, tuple[int, Candidate, float] | None]:
        """How many changes were evaluated, and the first that improves: its place, what it leads to, its value."""
        count = 0
        for place, way in enumerate(ways):
            if count == budget:
                break
            changed = way.made(state, step * self.grower.volume.cell, self._snapped)
            if changed is None:
                continue
            count += 1
            found = self.value(changed)
            if found > score + BETTER and changed.holds():
                return count, (place, changed, found)
        return count, None

    def _added(self, state: Candidate) -> Candidate | None:
        """The best valid state with one more prism, if it is better."""
        least = self.value(state) + BETTER
        valued = ((self.value(more), more) for more in self.grower.additions(state))
        better = [(found, more) for found, more in valued if found > least]
        ranked = sorted(better, key=lambda entry: -entry[0])
        return next((more for _, more in ranked if more.holds()), None)

    def _snapped(self, position: float, axis: int) -> float:
        """A position on an axis, or the plane of the model near it; never beyond the model."""
        volume = self.grower.volume
        low, high = volume.reach(axis)
        return min(max(self.grower.planes.snap(position, axis, NEAR * volume.cell), low), high)

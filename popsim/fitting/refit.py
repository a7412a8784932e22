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

MUCH = 0.005
"""Gain or loss that is much: of 400 changes that lost as much, 3 were worth it when they were tried again."""

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

        Changes are tried in turn, all round. One that improves is tried again at once; one that makes it much
        worse is not, with that step, before another one has made it much better.
        """
        score = self.value(state)
        for step in steps:
            position, worse, ways = 0, set[Move](), _moves(state, step)
            while budget > 0:
                left = [way for way in ways[position:] + ways[:position] if way not in worse]
                tries, better = self._better(state, left, step, score, budget, worse)
                budget -= tries
                if better is None:
                    break
                way, state, found = better
                before, ways = ways, _moves(state, step)
                position = ways.index(way) if ways == before else 0
                if ways != before or found > score + MUCH:
                    worse.clear()
                score = found
        return state

    def _better(
        self, state: Candidate, ways: Sequence[Move], step: float, score: float, budget: int, worse: set[Move]
    ) -> tuple[int, tuple[Move, Candidate, float] | None]:
        """How many changes were evaluated, and the first that improves: what it leads to, and its value.

        Such as make it much worse are put into `worse`.
        """
        count = 0
        for way in ways:
            if count == budget:
                break
            changed = way.made(state, step * self.grower.volume.cell, self._snapped)
            if changed is None:
                continue
            count += 1
            found = self.value(changed)
            if found > score + BETTER and changed.holds():
                return count, (way, changed, found)
            if found < score - MUCH:
                worse.add(way)
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


def _moves(state: Candidate, step: float) -> list[Move]:
    """The changes of a state that are tried with a step (cells); such as know no step with the coarsest only."""
    return [move for move in moves(state) if move.steps or step == max(STEPS)]

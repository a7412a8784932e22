"""Several greedy runs, the most promising of them refitted, the best of those completed."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from popsim.fitting.candidate import Candidate
from popsim.fitting.lookahead import Known, two_processes
from popsim.fitting.manners import MANNERS, Manner
from popsim.fitting.outset import Outset

REFITTED = 6
"""How many starts are refitted."""

COMPLETED = 2
"""How many of these are completed."""

HOPELESS = 0.03
"""Likeness by which the best start over a fold may fall behind that over another one."""


class State(NamedTuple):
    """A candidate over the fold of one outset, by its number, and how it was begun."""

    outset: int
    candidate: Candidate
    manner: Manner

    def key(self) -> object:
        """What tells it from others, however they were begun."""
        return self.outset, self.candidate.nodes


def search(outsets: Sequence[Outset]) -> State | None:
    """Find the candidate of greatest value that grows from an outset and keeps all conditions.

    Each fold that is not hopeless has its share of the work.

    Returns
    -------
    State or None
        The candidate, or None where nothing can be placed.
    """

    def begin(way: tuple[int, Manner]) -> Candidate:
        return outsets[way[0]].begun(way[1])

    def refit(state: State) -> Candidate:
        return outsets[state.outset].refitted(state.candidate)

    def complete(state: State) -> Candidate:
        return outsets[state.outset].completed(state.candidate)

    begun, refitted, completed = Known(begin, lambda way: way), Known(refit, State.key), Known(complete, State.key)
    with two_processes(*(outset.value for outset in outsets), begun, refitted, completed):
        ways = [(number, manner) for number in range(len(outsets)) for manner in MANNERS]
        left = _ranked(_different(begun.all(ways)), outsets)
        if not left:
            return None
        folds = sorted({state.outset for state, score in left if score > left[0][1] - HOPELESS})
        for count, further in ((REFITTED, refitted), (COMPLETED, completed)):
            share = count // len(folds)
            over = ([state for state, _ in left if state.outset == fold] for fold in folds)
            reached = further.all([state for states in over for state in states[:share]])
            left = _ranked([state._replace(candidate=found) for state, found in reached], outsets)
        return left[0][0]


def _different(begun: Iterable[tuple[tuple[int, Manner], Candidate]]) -> list[State]:
    """What manners lead to, each once, with the first manner that does."""
    found: dict[object, State] = {}
    for (number, manner), candidate in begun:
        state = State(number, candidate, manner)
        if candidate.nodes:
            found.setdefault(state.key(), state)
    return list(found.values())


def _ranked(states: Sequence[State], outsets: Sequence[Outset]) -> list[tuple[State, float]]:
    """States with their values, the greatest first."""
    scores: dict[object, float] = {}
    for number, outset in enumerate(outsets):
        own = [state for state in states if state.outset == number]
        for state, (_, score) in zip(own, outset.value.all([state.candidate for state in own]), strict=True):
            scores[state.key()] = score
    return sorted(((state, scores[state.key()]) for state in states), key=lambda scored: -scored[1])

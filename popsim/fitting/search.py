"""Several greedy runs, the most promising of them refitted, the best of those completed."""

from collections.abc import Sequence
from math import inf
from typing import NamedTuple

from popsim.beside import two_processes
from popsim.fitting.candidate import Candidate
from popsim.fitting.manners import MANNERS, Manner
from popsim.fitting.outset import Outset

REFITTED = 6
"""How many starts are refitted."""

COMPLETED = 2
"""How many of these are completed."""

HOPELESS = 0.03
"""Likeness by which the best start over a fold may fall behind that over another one, and any behind the best once
they are refitted. Before that starts from up to 0.1 behind have won, afterwards none from 0.027 (82 models)."""


class State(NamedTuple):
    """A candidate over the fold of one outset, by its number, how it was begun, and what it is worth."""

    outset: int
    candidate: Candidate
    manner: Manner
    value: float

    def key(self) -> object:
        """What tells it from others, however they were begun."""
        return self.outset, self.candidate.nodes


def search(outsets: Sequence[Outset]) -> State | None:
    """Find the candidate of greatest value that grows from an outset and keeps all conditions.

    Each fold that is not hopeless has its share of the work; one over which the model looks as over another has
    none.

    Returns
    -------
    State or None
        The candidate, or None where nothing can be placed.
    """

    def begin(way: tuple[int, Manner]) -> State | None:
        found = outsets[way[0]].begun(way[1])
        return State(way[0], found, way[1], outsets[way[0]].value(found)) if found.nodes else None

    def refit(state: State) -> State:
        return further(state, outsets[state.outset].refitted(state.candidate))

    def complete(state: State) -> State:
        return further(state, outsets[state.outset].completed(state.candidate))

    def further(state: State, found: Candidate) -> State:
        return state._replace(candidate=found, value=outsets[state.outset].value(found))

    numbers = _distinct(outsets)
    for number in numbers:
        outsets[number].coarse.look()
    with two_processes(begin, refit, complete) as share:
        begun = share(begin, [(number, manner) for number in numbers for manner in MANNERS])
        left = _ranked(_different([state for state in begun if state is not None]))
        if not left:
            return None
        folds = sorted({state.outset for state in left if state.value > left[0].value - HOPELESS})
        for count, work, behind in ((REFITTED, refit, inf), (COMPLETED, complete, HOPELESS)):
            hopeful = [state for state in left if state.value > left[0].value - behind]
            over = ([state for state in hopeful if state.outset == fold] for fold in folds)
            chosen = _different([state for states in over for state in states[: count // len(folds)]])
            left = _ranked(share(work, chosen))
    return left[0]


def _distinct(outsets: Sequence[Outset]) -> list[int]:
    """Numbers of outsets over whose folds the model looks otherwise than over earlier ones."""
    fronts = [outset.coarse.fronts for outset in outsets]
    return [k for k, own in enumerate(fronts) if not any(own.same_as(other) for other in fronts[:k])]


def _different(states: Sequence[State]) -> list[State]:
    """States, each once, however they were begun: the first of those that are the same."""
    found: dict[object, State] = {}
    for state in states:
        found.setdefault(state.key(), state)
    return list(found.values())


def _ranked(states: Sequence[State]) -> list[State]:
    """States by their values, the greatest first."""
    return sorted(states, key=lambda state: -state.value)

"""How deep behind each plate the model shows on it: what makes the abstraction look most like the model.

Too shallow, a plate loses what slants away from it; too deep, it shows in its own plane what lies far behind.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from popsim.fitting.candidate import Candidate
from popsim.fitting.refit import BETTER, Value
from popsim.mechanisms import Plate, plates_of

BEHIND = (0.3, 0.6, 1.0, 1.7, 3.0, 6.0)
"""Factors that are tried on the depth behind faces,"""

BESIDE = (0.0, 0.4, 1.0, 2.0, 4.0, 8.0)
"""and on that beyond them."""

AXIS = 0.01
"""Plates whose normals differ by less face one way."""


def deepened(state: Candidate, value: Value) -> Candidate:
    """Choose the depths of all plates anew, those of one axis together first, then those of each plane.

    They follow from the mechanisms alone, so that mechanisms that are kept show what they showed before.
    """
    for index in range(len(state.nodes)):
        state = state.with_depths(index, {})
    score = value(state)
    for index in range(len(state.nodes)):
        for plates in _groups(plates_of(state.mechanisms[index])):
            roles = [plate.role for plate in plates]
            for which, factors in enumerate((BEHIND, BESIDE)):
                if _matters(plates, which):
                    tries = [_changed(state, index, roles, which, factor) for factor in factors]
                    state, score = _better(state, score, tries, value)
    return state


def _better(state: Candidate, score: float, tries: Sequence[Candidate], value: Value) -> tuple[Candidate, float]:
    """A state and its value, or that of some with other depths, the least first, which is better."""
    if value(tries[0]) == value(tries[-1]) == score:
        return state, score  # nothing lies between the least depth and the greatest
    for changed in tries:
        found = value(changed)
        if found > score + BETTER:
            state, score = changed, found
    return state, score


def _matters(plates: Sequence[Plate], which: int) -> bool:
    """Whether the depth behind faces (0) of any of some plates, or that beyond them (1), tells what they show."""
    if which == 0:
        return any(plate.principal for plate in plates)
    return any(plate.room is not None and not np.array_equal(plate.outline, plate.room) for plate in plates)


def _changed(state: Candidate, index: int, roles: Sequence[str], which: int, factor: float) -> Candidate:
    """The state with one factor of some plates of a node replaced."""
    known = dict(state.nodes[index].depths)
    for role in roles:
        behind, beside = known.get(role, (1.0, 1.0))
        known[role] = (factor, beside) if which == 0 else (behind, factor)
    return state.with_depths(index, {role: factors for role, factors in known.items() if factors != (1.0, 1.0)})


def _groups(plates: Sequence[Plate]) -> Iterator[list[Plate]]:
    """Plates whose depths are chosen together."""
    seen = set()
    for same in (_on_one_axis, _in_one_plane):
        left = list(plates)
        while left:
            group = [plate for plate in left if same(left[0], plate)]
            roles = frozenset(plate.role for plate in group)
            left = [plate for plate in left if plate.role not in roles]
            if roles not in seen:
                seen.add(roles)
                yield group


def _on_one_axis(first: Plate, second: Plate) -> bool:
    return first.principal == second.principal and bool(abs(first.outward @ second.outward) > 1 - AXIS)


def _in_one_plane(first: Plate, second: Plate) -> bool:
    off = abs(float(first.outward @ (second.outline[0] - first.outline[0])))
    same = first.principal == second.principal and bool(first.outward @ second.outward > 1 - AXIS)
    return same and off < AXIS * float(np.ptp(first.outline, axis=0).max())

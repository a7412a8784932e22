"""Parts that will turn about one line, joined there or not yet: while they meet on it, they touch for ever."""

from itertools import combinations

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import BoolArray, cross
from popsim.geometry.rigid import transform
from popsim.simulation.neighbours import companions, hinge_lines
from popsim.simulation.sweep import Sweep
from popsim.simulation.turning import Turn, free_turns

MEETS = 0.02
"""mm; lines of two parts nearer than this are one."""

Pair = frozenset[str]


class OnLine:
    """The pairs of parts of a design that have a hinge line in common."""

    def __init__(self, design: Design) -> None:
        lines = hinge_lines(design)
        pairs = [
            (frozenset(pair), hinges[0].points)
            for hinges in lines
            for pair in combinations(sorted({name for hinge in hinges for name in hinge.patches}), 2)
        ]
        turns = free_turns(design, [*design.hinges, *companions(design, lines)])
        self._pairs = [pair for pair, _ in pairs]
        self._lines = np.array([line for _, line in pairs]).reshape(-1, 2, 3)
        self._turns = {frozenset(turn.hinge.patches): turn for turn in turns.values()}

    def met(self, sweep: Sweep) -> dict[Pair, BoolArray]:
        """At which recorded angles two of the parts that move meet on a line of both, shape (n,) each."""
        here = [k for k, pair in enumerate(self._pairs) if pair <= sweep.index.keys()]
        if not here:
            return {}
        places = np.array([[sweep.index[name] for name in sorted(self._pairs[k])] for k in here])
        one, other = (transform(sweep.poses[:, places[:, side]], self._lines[here]) for side in (0, 1))
        along = one[..., 1, :] - one[..., 0, :]
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        away = np.linalg.norm(cross(other - one[..., :1, :], along[..., None, :]), axis=-1).max(axis=-1)
        found: dict[Pair, BoolArray] = {}
        for column, k in enumerate(here):
            meets = away[:, column] < MEETS
            found[self._pairs[k]] = found.get(self._pairs[k], False) | meets
        return found

    def turn(self, pair: Pair) -> Turn | None:
        """How far two parts turn freely about their line; None where one ends before the other begins."""
        return self._turns.get(pair)

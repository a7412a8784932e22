"""The best combination of prisms on all base patch pairs, by dynamic programming (Sec. 4.1).

The accumulated error is that of Eq. 1, summed over all points: a point in the consensus set of a prism counts with
the error_fit of that prism, any other with 1; each patch adds its price. On an opening pair prisms are chosen by
weighted interval scheduling over their closing ranges (Sec. 3.3.2), each with the best that can stand on the pairs
it offers; so ranges are respected while choosing.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from popsim.fitting.candidate import Candidate, Node
from popsim.fitting.knobs import thinnest
from popsim.fitting.mapping import mappings
from popsim.fitting.ransac import Hypothesis, Weights, fitted_prisms, over_pair
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import BasePatchPair, Mechanism, PairKind, Primitive, plates_of

WIDTHS = (6, 2, 1)
"""Prisms that are considered on the card, on what stands on it, and on what stands on that, where it ends."""

FEWEST = 12
"""Points; fewer over a pair are noise."""

TOUCH = 1e-6
"""mm by which neighbours may touch."""


@dataclass(frozen=True)
class Plan:
    """A prism on a pair, what stands on it, and by how much they lower the accumulated error."""

    primitive: Primitive
    pair: BasePatchPair
    saving: float
    above: "tuple[Plan, ...]" = ()


@dataclass(frozen=True, eq=False)
class Combiner:
    """Chooses combinations of prisms.

    Attributes
    ----------
    points:
        Pseudo vertices of the model, evenly spread, card frame, mm, shape (n, 3).
    weights:
        Of Eq. 1.
    price:
        Of a patch, as a share of all points.
    rng:
        Draws hypotheses.
    """

    points: FloatArray
    weights: Weights
    price: float
    rng: Generator

    def combined(self, state: Candidate) -> Candidate:
        """The state with the combination of least accumulated error on its pairs, as far as conditions hold."""
        every = np.ones(len(self.points), dtype=bool)
        for pair, parent in state.pairs:
            for plan in self._best(state, pair, every, 0):
                state = _placed(state, plan, parent)
        return state

    def _best(self, state: Candidate, pair: BasePatchPair, left: BoolArray, depth: int) -> tuple[Plan, ...]:
        """The best prisms on a pair for the points that are left; each saves something."""
        own = left & _over(self.points, pair)
        if depth == len(WIDTHS) or np.count_nonzero(own) < FEWEST:
            return ()
        options = []
        for hypothesis in fitted_prisms(self.points[own], pair, self.weights, self.rng, WIDTHS[depth]):
            mapped = mappings(hypothesis.primitive, pair, f"M{depth}", state.wishes.allows)
            if thinnest(hypothesis.primitive) >= state.least and mapped:
                options.append(self._option(state, pair, own, left, hypothesis, mapped[0].mechanism, depth))
        chosen = _apart(options) if pair.kind is PairKind.OPENING else _one(options)
        return tuple(sorted(chosen, key=lambda plan: -plan.saving))

    def _option(
        self,
        state: Candidate,
        pair: BasePatchPair,
        own: BoolArray,
        left: BoolArray,
        found: Hypothesis,
        mechanism: Mechanism,
        depth: int,
    ) -> tuple[Plan, tuple[float, float]]:
        """A prism with the best that can stand on it, and its closing range."""
        rest = left.copy()
        rest[np.flatnonzero(own)[found.consensus]] = False
        saving = np.count_nonzero(found.consensus) * (1 - found.error) / len(self.points)
        saving -= self.price * len(plates_of(mechanism))
        above = tuple(
            plan for offered in mechanism.pairs() for plan in self._best(state, offered, rest, depth + 1)
        )
        total = float(saving) + sum(plan.saving for plan in above)
        return Plan(found.primitive, pair, total, above), mechanism.closing_range()


def _over(points: FloatArray, pair: BasePatchPair) -> BoolArray:
    """Which points lie over a pair."""
    x, u, v = over_pair(points, pair).T
    if pair.kind is PairKind.OPENING:
        across, top = u <= min(pair.reach) + TOUCH, np.inf
    else:
        across, top = (u > TOUCH) & (u <= pair.reach[0]), pair.reach[1]
    return np.asarray((pair.x[0] <= x) & (x <= pair.x[1]) & across & (v > TOUCH) & (v <= top + TOUCH))


def _one(options: Sequence[tuple[Plan, tuple[float, float]]]) -> list[Plan]:
    """The plan that saves most, if any saves anything: a corner holds one."""
    plans = [plan for plan, _ in options if plan.saving > 0]
    return [max(plans, key=lambda plan: plan.saving)] if plans else []


def _apart(options: Sequence[tuple[Plan, tuple[float, float]]]) -> list[Plan]:
    """Of plans with ranges those that save most together and do not overlap: weighted interval scheduling."""
    free = [one for one in options if one[0].saving > 0 and _within(one[1], one[0].pair.free)]
    line = sorted(free, key=lambda one: one[1][1])
    ends = [end for _, (_, end) in line]
    best: list[tuple[float, list[Plan]]] = [(0.0, [])]
    for number, (plan, (start, _)) in enumerate(line):
        saved, before = best[bisect_right(ends, start + TOUCH, 0, number)]
        best.append(max(best[-1], (saved + plan.saving, [*before, plan]), key=lambda entry: entry[0]))
    return best[-1][1]


def _within(inner: tuple[float, float], outer: tuple[float, float]) -> bool:
    return outer[0] - TOUCH <= inner[0] and inner[1] <= outer[1] + TOUCH


def _placed(state: Candidate, plan: Plan, parent: int | None) -> Candidate:
    """The state with a plan, as far as all conditions hold."""
    grown = state.with_node(Node(plan.primitive, plan.pair, parent))
    if grown is None or not grown.holds():
        return state
    index = len(grown.nodes) - 1
    for further in plan.above:
        grown = _placed(grown, further, index)
    return grown

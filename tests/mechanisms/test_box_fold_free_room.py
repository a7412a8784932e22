"""What a layered box-fold leaves free on its lower tops."""

from collections.abc import Sequence

import numpy as np
import pytest
from oracles.crossing import crossings

from popsim.design import Card
from popsim.mechanisms import BasePatchPair, Mechanism, PairKind, Plate, assemble, card_pair, plates_together
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top
from popsim.mechanisms.v_fold_2 import VFold2
from popsim.validity import examine

CARD = Card(x=(-150.0, 150.0), depth=200.0)
TOPS = (Top(-60.0, 0.0, 20.0), Top(0.0, 40.0, 60.0))
FOLDING = np.radians([170.0, 150.0, 120.0, 90.0, 60.0, 30.0])


def lower_top(box: BoxFold) -> BasePatchPair:
    return min((pair for pair in box.pairs() if pair.kind is PairKind.OPENING), key=lambda pair: pair.v)


def test_pair_at_the_step_keeps_its_sweep_free() -> None:
    box = BoxFold.stepped("M1", card_pair(CARD), 30.0, TOPS)
    assert lower_top(box).free == (-np.inf, -30.0)


def reach(plates: Sequence[Plate], role: str) -> tuple[float, float]:
    (x,) = (plate.room[:, 0] for plate in plates if plate.role == role and plate.room is not None)
    return float(x.min()), float(x.max())


def test_sides_reach_along_the_fold_where_nothing_else_stands() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 10.0, 50.0, (-60.0, -20.0))
    far = BoxFold.plain("M2", card_pair(CARD), 15.0, 30.0, (60.0, 90.0))
    above = BoxFold.plain("M3", next(iter(far.pairs())), 5.0, 30.0, (70.0, 80.0))
    alone = plates_together([box])["M1"]
    together = plates_together([box, far, above])
    for side in ("L", "R"):
        assert reach(alone, side) == (-150.0, 150.0)
        assert reach(together["M1"], side) == (-150.0, far.closing_range()[0])
        assert reach(together["M2"], side) == (box.closing_range()[1], 150.0)
        assert reach(together["M3"], side) == (60.0, 90.0)
    for role in ("C", "T_G"):
        assert reach(together["M1"], role) == reach(alone, role) == (-60.0, -20.0)


def test_higher_top_without_a_pair_at_its_step_ends_what_is_free() -> None:
    box = BoxFold("M1", card_pair(CARD), 30.0, TOPS, (EndPair(-60.0, 0.0, 20.0, -1),))
    assert lower_top(box).free == (-np.inf, 0.0)


@pytest.mark.parametrize(
    "child",
    [
        lambda pair: BoxFold.plain("M2", pair, 20.0, 15.0, (-35.0, -5.0)),
        lambda pair: VFold2("M2", pair, -2.0, 20.0, 80.0, 1),
    ],
    ids=["box", "v-fold"],
)
def test_what_leans_into_the_higher_part_crosses_it_and_is_refused(child) -> None:
    box = BoxFold("M1", card_pair(CARD), 30.0, TOPS, (EndPair(-60.0, 0.0, 20.0, -1),))
    leaning: Mechanism = child(lower_top(box))
    design = assemble(CARD, [box, leaning])
    theory = examine(design)
    assert any(crossings(design, theory.poses(FOLDING), FOLDING))
    assert {condition.aspect for condition in theory.conditions if not condition.holds} == {"clear"}

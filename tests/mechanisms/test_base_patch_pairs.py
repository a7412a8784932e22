"""Base patch pairs (Sec. 4.1, constraint 3)."""

import numpy as np
import pytest

from popsim.design import Card
from popsim.errors import GeometryError
from popsim.geometry.frame import Side
from popsim.mechanisms import BasePatchPair, PairKind, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1

CARD = Card(x=(-105.0, 105.0), depth=148.0)


def named(pairs: tuple[BasePatchPair, ...]) -> set[frozenset[str]]:
    return {frozenset(pair.patches) for pair in pairs}


def find(pairs: tuple[BasePatchPair, ...], *patches: str) -> BasePatchPair:
    return next(pair for pair in pairs if set(pair.patches) == set(patches))


def test_figure_13() -> None:
    """{B, G}; the prism in the centre adds {F1, F2}, {F3, B}, {F4, G}; one on {F4, G} adds {F4, F5}, {F6, G}.

    The text of the paper calls the fifth pair {F4, F2}; the figure's caption, {F4, F5}, is meant: the side of the
    first prism and the top of the second. The triangular prism on {F1, F2} adds none.
    """
    f1, f2, f3, f4, f5, f6 = "M1.T_G", "M1.T_B", "M1.R", "M1.L", "M2.tread", "M2.riser"
    first = card_pair(CARD)
    assert named((first,)) == {frozenset("GB")}
    prism = BoxFold.plain("M1", first, 30.0, 50.0, (-40.0, 40.0))
    assert named(prism.pairs()) == {frozenset(pair) for pair in ((f1, f2), (f3, "B"), (f4, "G"))}
    beside = StepFold("M2", find(prism.pairs(), f4, "G"), (-30.0, 30.0), 25.0, 30.0)
    assert named(beside.pairs()) == {frozenset(pair) for pair in ((f4, f5), (f6, "G"))}
    roof = TentFold("M3", find(prism.pairs(), f1, f2), (-40.0, 40.0), 30.0, 20.0)
    assert roof.pairs() == ()
    assert len(assemble(CARD, [prism, beside, roof]).mechanisms) == 3


def test_card_is_an_opening_pair_as_large_as_its_pages() -> None:
    pair = card_pair(CARD)
    assert pair.kind is PairKind.OPENING
    assert (pair.u, pair.v, pair.x, pair.reach, pair.owner) == (0.0, 0.0, (-105.0, 105.0), (148.0, 148.0), None)


def test_top_of_a_box_is_a_card_again_shifted_by_its_height() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 30.0, 50.0, (-40.0, 40.0))
    top = find(box.pairs(), "M1.T_G", "M1.T_B")
    assert (top.kind, top.u, top.v, top.x, top.reach) == (PairKind.OPENING, 0.0, 50.0, (-40.0, 40.0), (30.0, 30.0))


def test_corners_of_a_box() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 30.0, 50.0, (-40.0, 40.0))
    for side, floor, wall in ((Side.GROUND, "G", "M1.L"), (Side.BACKDROP, "B", "M1.R")):
        corner = find(box.pairs(), floor, wall)
        assert corner.patches == (floor, wall)
        assert (corner.kind, corner.side, corner.u, corner.v) == (PairKind.CORNER, side, 30.0, 0.0)
        assert corner.reach == (118.0, 50.0)


def test_corner_between_a_box_and_the_top_it_stands_on() -> None:
    """A step between patch R of the upper box and T_B of the lower one is the paper's own example (Sec. 3.3.2)."""
    lower = BoxFold.plain("M1", card_pair(CARD), 40.0, 30.0, (-40.0, 40.0))
    upper = BoxFold.plain("M2", find(lower.pairs(), "M1.T_G", "M1.T_B"), 25.0, 30.0, (-10.0, 10.0))
    corner = find(upper.pairs(), "M1.T_B", "M2.R")
    assert (corner.u, corner.v, corner.reach, corner.owner) == (25.0, 30.0, (15.0, 30.0), "M2")


def test_box_as_wide_as_its_base_leaves_no_corner() -> None:
    lower = BoxFold.plain("M1", card_pair(CARD), 40.0, 30.0, (-40.0, 40.0))
    upper = BoxFold.plain("M2", find(lower.pairs(), "M1.T_G", "M1.T_B"), 40.0, 30.0, (-10.0, 10.0))
    assert named(upper.pairs()) == {frozenset(("M2.T_G", "M2.T_B"))}


def test_corners_of_a_step() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 30.0, 50.0, (-40.0, 40.0))
    step = StepFold("M2", find(box.pairs(), "G", "M1.L"), (-20.0, 20.0), 25.0, 30.0)
    outer, upper = find(step.pairs(), "G", "M2.riser"), find(step.pairs(), "M2.tread", "M1.L")
    assert (outer.u, outer.v, outer.reach) == (55.0, 0.0, (93.0, 30.0))
    assert (upper.u, upper.v, upper.reach) == (30.0, 30.0, (25.0, 20.0))


def test_step_as_high_as_its_wall_leaves_no_corner_above() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 30.0, 50.0, (-40.0, 40.0))
    step = StepFold("M2", find(box.pairs(), "G", "M1.L"), (-20.0, 20.0), 25.0, 50.0)
    assert named(step.pairs()) == {frozenset(("G", "M2.riser"))}


def test_every_top_of_a_layered_box_is_a_pair() -> None:
    tops = (Top(-40.0, -10.0, 20.0), Top(-10.0, 20.0, 45.0), Top(20.0, 40.0, 30.0))
    pairs = BoxFold.stepped("M1", card_pair(CARD), 30.0, tops).pairs()
    opening = [pair for pair in pairs if pair.kind is PairKind.OPENING]
    assert [(pair.x, pair.v) for pair in opening] == [(top[:2], top.height) for top in tops]
    assert [pair.free for pair in opening] == [(-np.inf, -40.0), (-np.inf, np.inf), (50.0, np.inf)]


def test_v_fold_offers_none() -> None:
    assert VFold1("M1", card_pair(CARD), 40.0, 30.0, 20.0).pairs() == ()


@pytest.mark.parametrize("change", [{"x": (3.0, 3.0)}, {"u": 5.0}])
def test_pairs_that_are_none(change: dict[str, object]) -> None:
    fields = {name: getattr(card_pair(CARD), name) for name in BasePatchPair.__dataclass_fields__}
    with pytest.raises(GeometryError, match="pair"):
        BasePatchPair(**fields | change)

"""What is shut in and what is not."""

import pytest

from popsim.assembly.openness import HIDDEN, openness
from popsim.design import Card
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.tent_fold import TentFold

CARD = Card(x=(-60, 60), depth=90)


def test_a_backbone_is_shut_in_and_sides_are_not() -> None:
    seen = openness(lay_out(assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])).parts)
    assert seen["M1.C"] == 0
    assert all(share > 0.4 for name, share in seen.items() if name != "M1.C")


def test_under_a_tent_there_is_light_from_both_ends() -> None:
    parts = lay_out(assemble(CARD, [TentFold("M1", card_pair(CARD), (-10, 10), 20, 25)])).parts
    assert min(openness(parts).values()) > HIDDEN


def test_a_bare_card_is_seen_from_above_all_over() -> None:
    assert openness(lay_out(assemble(CARD, [])).parts) == pytest.approx({"G": 1.0, "B": 1.0})

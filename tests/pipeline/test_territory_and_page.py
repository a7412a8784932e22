"""Which space belongs to which mechanism, and how large the pages must be."""

import numpy as np
import pytest

from popsim.design import Card
from popsim.mechanisms import PairKind, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.pipeline.page import MARGIN, fitting_card
from popsim.pipeline.territory import territories

BASE = card_pair(Card(x=(-500.0, 500.0), depth=500.0))
SPACE = np.array([[-100.0, -60.0, 0.0], [100.0, 60.0, 120.0]])


def test_neighbours_part_the_space_between_them() -> None:
    first = BoxFold.plain("M1", BASE, 20.0, 30.0, (-80.0, -30.0))
    second = BoxFold.plain("M2", BASE, 20.0, 30.0, (30.0, 80.0))
    found = territories([first, second], SPACE)
    assert found["M1"][1, 0] == found["M2"][0, 0] == 0.0
    assert found["M1"][0, 0] < -100 and found["M2"][1, 0] > 100


def test_what_stands_on_a_base_begins_at_its_top() -> None:
    low = BoxFold.plain("M1", BASE, 40.0, 30.0, (-80.0, 80.0))
    top = next(pair for pair in low.pairs() if pair.kind is PairKind.OPENING)
    high = BoxFold.plain("M2", top, 20.0, 30.0, (-20.0, 20.0))
    found = territories([low, high], SPACE)
    assert found["M1"][1, 2] > 120.0
    assert found["M2"][0, 2] == 30.0


def test_step_keeps_to_its_side() -> None:
    box = BoxFold.plain("M1", BASE, 20.0, 60.0, (-50.0, 50.0))
    corners = [pair for pair in box.pairs() if pair.kind is PairKind.CORNER]
    for pair in corners:
        y = territories([box, StepFold("M2", pair, (-20.0, 20.0), 15.0, 25.0)], SPACE)["M2"][:, 1]
        assert (y[0] == 20.0) if pair.side.value > 0 else (y[1] == -20.0)


def test_pages_hold_the_closed_box_with_a_margin() -> None:
    box = BoxFold.plain("M1", BASE, 20.0, 60.0, (-50.0, 40.0))
    card = fitting_card([box])
    assert card.depth == pytest.approx(80.0 + MARGIN)
    assert card.x == pytest.approx((-70.0 - MARGIN, 70.0 + MARGIN))


def test_outlines_beyond_the_faces_count() -> None:
    box = BoxFold.plain("M1", BASE, 20.0, 60.0, (-50.0, 40.0))
    taller = np.array([[-50.0, 20.0, 0.0], [40.0, 20.0, 0.0], [40.0, 20.0, 75.0], [-50.0, 20.0, 75.0]])
    assert fitting_card([box], {"M1.L": taller}).depth == pytest.approx(95.0 + MARGIN)

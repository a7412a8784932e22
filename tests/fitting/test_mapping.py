"""Which mechanism goes first for a primitive: what shows most, and of equals what is built soonest."""

from dataclasses import dataclass

import numpy as np
import pytest

from popsim.design import Card
from popsim.fitting.mapping import EQUALLY, easiest_first
from popsim.mechanisms import Mechanism, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.effort import PER_CREASE, PER_JOINT, PER_METRE, minutes_of
from popsim.mechanisms.tent_fold import TentFold

PAIR = card_pair(Card(x=(-200.0, 200.0), depth=200.0))
BOX = BoxFold.plain("M1", PAIR, 20, 30, (-30, 30))
TENT = TentFold("M1", PAIR, (0, 20), 20, 25)


@dataclass(frozen=True)
class Stated:
    """A mechanism with an error as stated."""

    mechanism: Mechanism
    error_cover: float


def test_a_tent_takes_one_crease_two_joints_and_the_rim_of_both_sides() -> None:
    slope = np.hypot(20, 25)
    cut = 2 * 20 + 4 * slope
    assert minutes_of(TENT) == pytest.approx(PER_METRE * cut / 1000 + PER_CREASE + 2 * PER_JOINT)


def test_of_equals_the_easier_goes_first() -> None:
    assert minutes_of(TENT) < minutes_of(BOX)
    box, tent = Stated(BOX, 0.1), Stated(TENT, 0.1 + 0.9 * EQUALLY)
    assert easiest_first([box, tent]) == easiest_first([tent, box]) == (tent, box)


def test_what_shows_more_goes_first_however_long_it_takes() -> None:
    box, tent = Stated(BOX, 0.1), Stated(TENT, 0.1 + 1.1 * EQUALLY)
    assert easiest_first([tent, box]) == (box, tent)


def test_equals_are_measured_from_the_best_of_them() -> None:
    """Nothing gets to the front by a chain of small differences."""
    steps = [Stated(BOX, 0.0), Stated(BOX, 0.8 * EQUALLY), Stated(TENT, 1.6 * EQUALLY)]
    assert easiest_first(steps)[-1] is steps[-1]

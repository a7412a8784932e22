"""Designs that layouts are tested on."""

import pytest

from popsim.design import Card, Design
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold

CARD = Card(x=(-60, 60), depth=90)
"""Goes onto A4 in one piece."""


@pytest.fixture(scope="session")
def bare_card() -> Design:
    """Ground and backdrop alone."""
    return assemble(CARD, [])


@pytest.fixture(scope="session")
def box() -> Design:
    """One box-fold, 60 long, 40 wide, 30 high, over the middle of the card."""
    return assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])

"""The searches against brute force."""

from itertools import combinations, pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.design import Card
from popsim.fitting.field import Spot
from popsim.fitting.layers import Layers
from popsim.fitting.proposal import Prices
from popsim.fitting.rows import STEP_PATCHES, propose_row
from popsim.fitting.runs import best_run
from popsim.mechanisms import PrismRow, card_pair

PAIR = card_pair(Card(x=(-100.0, 100.0), depth=100.0))


@given(st.lists(st.integers(-5, 5), min_size=1, max_size=12))
def test_best_run_is_the_greatest_sum_of_neighbours(values: list[int]) -> None:
    gain, first, last = best_run(np.array(values, float)[:, None])
    sums = {(a, b): sum(values[a:b]) for a, b in combinations(range(len(values) + 1), 2)}
    assert gain[0] == max(0, *sums.values())
    assert gain[0] == sum(values[int(first[0]) : int(last[0])])


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_row_is_the_best_rising_then_falling_profile(seed: int) -> None:
    gain = np.random.default_rng(seed).integers(-4, 6, (5, 1, 3)).astype(float)
    price = 0.25
    spot = Spot(PAIR, gain, np.zeros(3), 1.0)
    column = gain[:, 0].cumsum(axis=1)
    best = 0.0
    for heights in product(range(4), repeat=5):
        used = [x for x in range(5) if heights[x]]
        if not used or used != list(range(used[0], used[-1] + 1)):
            continue
        profile = [heights[x] for x in used]
        peak = profile.index(max(profile))
        if profile[:peak] != sorted(profile[:peak]) or profile[peak:] != sorted(profile[peak:], reverse=True):
            continue
        steps = sum(a != b for a, b in pairwise(profile))
        best = max(best, sum(column[x, heights[x] - 1] for x in used) - price * STEP_PATCHES * steps)
    found = propose_row(spot, Prices(price))
    steps = 0 if found is None else len(found.primitive.tops) - 1
    value = 0.0 if found is None else found.gain - price * STEP_PATCHES * steps
    assert value == pytest.approx(best)


def test_row_of_a_staircase_has_its_steps() -> None:
    gain = np.full((9, 2, 4), -1.0)
    for x, h in enumerate((1, 1, 1, 4, 4, 4, 2, 2, 2)):
        gain[x, :, :h] = 1.0
    found = propose_row(Spot(PAIR, gain, np.zeros(3), 1.0), Prices(0.1))
    assert isinstance(found.primitive, PrismRow)
    assert found.primitive.half_width == 2.0
    assert found.primitive.tops == ((0.0, 3.0, 1.0), (3.0, 6.0, 4.0), (6.0, 9.0, 2.0))
    assert found.gain == 42


def test_row_steps_and_ends_only_where_layers_allow_it() -> None:
    gain = np.full((9, 2, 4), -1.0)
    for x, h in enumerate((1, 1, 1, 4, 4, 4, 2, 2, 2)):
        gain[x, :, :h] = 1.0
    spot = Spot(PAIR, gain, np.zeros(3), 1.0)
    layers = Layers.of((1.1, 4.0), (6.2,), (2.9,))
    found = propose_row(spot, Prices(0.1), None, layers.allowed(spot))
    assert isinstance(found.primitive, PrismRow)
    assert found.primitive.tops == ((0.0, 3.0, 1.0), (3.0, 6.0, 4.0), (6.0, 9.0, 1.0))  # no layer lies at 2
    nowhere = Layers.of((4.0,), (), ())
    plain = propose_row(spot, Prices(0.1), None, nowhere.allowed(spot))
    assert isinstance(plain.primitive, PrismRow) and len(plain.primitive.tops) == 1

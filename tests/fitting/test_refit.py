"""Refitting climbs, but not beyond the model."""

import pytest
from fitting_surfaces import block, subject_of, surface

from popsim.design import Card
from popsim.fitting.candidate import Node, build
from popsim.fitting.greedy import Grower, Taste
from popsim.fitting.knobs import knobs
from popsim.fitting.refit import MUCH, STEPS, Climber, valued
from popsim.fitting.volume import CELLS
from popsim.mechanisms import PrismRow, card_pair

CARD = Card(x=(-300, 300), depth=300)


BLOCK = block((-48, -20, 0), (48, 20, 30))
ROW = PrismRow(12.0, 0.0, ((-30.0, -5.0, 18.0), (-5.0, 20.0, 9.0)))


def started(*tops):
    made = build(CARD, [Node(PrismRow(12.0, 0.0, tops), card_pair(CARD), None)], 1.0)
    assert made is not None
    return made


def climber(worth):
    subject = subject_of(surface(BLOCK))
    return Climber(valued(worth), Grower(subject.volume, subject.planes, Taste(0.01, 1.0, 0.5, 100)))


def test_borders_go_to_the_end_of_the_model_where_larger_is_better_and_no_farther():
    def extents(state):
        half, *along = [at for axis, at in knobs(state.nodes[0].primitive) if axis < 2]
        return half, along[0], along[-1], max(at for axis, at in knobs(state.nodes[0].primitive) if axis == 2)

    def size(state):
        half, first, last, top = extents(state)
        return half + (last - first) + top

    found = climber(size).refit(started((-30.0, 20.0, 18.0)), 500)
    assert extents(found) == pytest.approx((20, -48, 48, 30), abs=96 / CELLS)


def tried(worth, steps=STEPS):
    """In turn all that is evaluated from a row of two tops on; the number of its tops, and its half width."""
    seen = []

    def watched(state):
        row = state.nodes[0].primitive
        seen.append((len(row.tops), row.half_width))
        return worth(row)

    climber(watched).refit(started(*ROW.tops), 500, steps)
    return seen


def test_what_knows_no_step_is_tried_with_the_coarsest_only():
    assert any(tops == 1 for tops, _ in tried(lambda row: 0.0, STEPS[:1])[1:])
    assert not any(tops == 1 for tops, _ in tried(lambda row: 0.0, STEPS[1:])[1:])


@pytest.mark.parametrize(("gain", "again"), [(MUCH / 4, False), (2 * MUCH, True)])
def test_what_made_it_much_worse_is_tried_again_once_all_is_much_better(gain, again):
    """Narrower is much worse; each step up of the first top gains something, up to a height."""

    def worth(row):
        return gain * min(round(row.tops[0][2]), 24) - (1.0 if row.half_width < ROW.half_width else 0.0)

    narrower = [half for tops, half in tried(worth, (1.5,)) if half < ROW.half_width]
    assert narrower and (len(narrower) > 1) == again

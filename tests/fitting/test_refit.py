"""Refitting climbs, but not beyond the model."""

import pytest
from fitting_surfaces import block, subject_of, surface

from popsim.design import Card
from popsim.fitting.candidate import Node, build
from popsim.fitting.greedy import Grower, Taste
from popsim.fitting.knobs import knobs
from popsim.fitting.refit import Climber, valued
from popsim.mechanisms import PrismRow, card_pair

CARD = Card(x=(-300, 300), depth=300)


def test_borders_go_to_the_end_of_the_model_where_larger_is_better_and_no_farther():
    subject = subject_of(surface(block((-48, -20, 0), (48, 20, 30))))
    start = build(CARD, [Node(PrismRow(12.0, 0.0, ((-30.0, 20.0, 18.0),)), card_pair(CARD), None)], 1.0)

    def extents(state):
        half, *along = [at for axis, at in knobs(state.nodes[0].primitive) if axis < 2]
        return half, along[0], along[-1], max(at for axis, at in knobs(state.nodes[0].primitive) if axis == 2)

    def size(state):
        half, first, last, top = extents(state)
        return half + (last - first) + top

    climber = Climber(valued(size), Grower(subject.volume, subject.planes, Taste(0.01, 1.0, 0.5, 100)))
    assert extents(climber.refit(start, 500)) == pytest.approx((20, -48, 48, 30), abs=subject.volume.cell)

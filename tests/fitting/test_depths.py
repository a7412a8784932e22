"""Depths are chosen so that the abstraction looks most like the model, and go with it wherever it goes."""

import numpy as np
import pytest

from popsim.design import Card
from popsim.fitting.candidate import Node, build
from popsim.fitting.depths import deepened
from popsim.fitting.refit import valued
from popsim.fitting.scale import scaled_node
from popsim.mechanisms import PrismRow, RectangularPrism, TriangularPrism, card_pair, plates_together

CARD = Card(x=(-300, 300), depth=300)
BOX = build(CARD, [Node(PrismRow(30.0, 0.0, ((-50.0, 50.0, 40.0),)), card_pair(CARD), None)], 1.0)


def behind(state, role):
    plates = {plate.role: plate for plate in plates_together(state.mechanisms, state.depths)["M1"]}
    return plates[role].behind


def test_the_best_factor_of_each_plate_is_found():
    wanted = {"F_L": 60.0, "F_R": 60.0, "B_L": 12.0, "B_R": 12.0}

    def value(state):
        return -sum(abs(np.log(behind(state, role) / depth)) for role, depth in wanted.items())

    found = deepened(BOX, valued(value))
    for role, depth in wanted.items():
        assert behind(found, role) == pytest.approx(depth)
    assert behind(found, "L") == behind(BOX, "L")


def test_nothing_changes_where_nothing_is_gained():
    assert deepened(BOX, valued(lambda state: 1.0)) == BOX


def test_depths_stay_with_a_node_that_moves_and_scales_and_go_with_its_plates():
    deep = BOX.with_depths(0, {"L": (0.3, 2.0)})
    assert deep.depths == {"M1.L": (0.3, 2.0)}
    wider = deep.with_primitive(0, PrismRow(35.0, 0.0, ((-50.0, 50.0, 40.0),)))
    assert wider.depths == deep.depths
    assert scaled_node(deep.nodes[0], 2.0).depths == deep.nodes[0].depths
    stepped = deep.with_primitive(0, PrismRow(35.0, 0.0, ((-50.0, 0.0, 40.0), (0.0, 50.0, 20.0))))
    assert stepped.depths == {}


def test_ears_end_where_something_stands_in_the_corner_beside_them():
    step = Node(RectangularPrism((-45.0, 30.0, 0.0), (45.0, 36.0, 30.0)), BOX.mechanisms[0].pairs()[1], 0)
    both = BOX.with_node(step)
    alone, beside = (
        {plate.role: plate.room for plate in plates_together(state.mechanisms)["M1"]} for state in (BOX, both)
    )
    assert alone["F_L"][:, 1].max() > 35 and beside["F_L"][:, 1].max() == pytest.approx(30.0)
    assert alone["F_R"][:, 1].min() == beside["F_R"][:, 1].min() < -35


def test_a_roof_has_depths_of_its_own():
    roof = Node(TriangularPrism((-50.0, -30.0, 0.0), (50.0, 30.0, 30.0), "x", 1), card_pair(CARD), None)
    state = build(CARD, [roof], 1.0)
    assert state is not None
    deep = deepened(state, valued(lambda changed: behind(changed, "T_3")))
    assert behind(deep, "T_3") == pytest.approx(6 * behind(state, "T_3"))

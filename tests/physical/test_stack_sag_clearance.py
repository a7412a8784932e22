"""Closed stack, sag and clearance against what can be worked out by hand."""

import numpy as np
import pytest
from folding_designs import CARD, CARD_PAIR, corners, plain_box, tower

from popsim.mechanisms import assemble
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.stock import Stock

STOCK = Stock.of(200)


def boxed_step(depth: float):
    """A step on a box, whose riser stands `depth` mm before its wall."""
    box = BoxFold.plain("M", CARD_PAIR, 40, 60, (-40, 40))
    return assemble(CARD, [box, StepFold("S", corners(box)[0], (-30, 30), depth, 30)])


def test_a_card_without_pop_up_is_two_layers(on_paper):
    stack = on_paper(assemble(CARD, []), STOCK).stack
    assert stack.height == pytest.approx(2 * STOCK.thickness)
    assert stack.patches == ("G", "B")


def test_a_box_is_six_layers_between_its_backbone_and_its_far_edge(on_paper):
    """Pages, sides and tops lie on each other from the top of the backbone (40) to 30 + 40."""
    stack = on_paper(plain_box(half_width=30, height=40), STOCK).stack
    assert set(stack.patches) == {"G", "B", "M.L", "M.R", "M.T_G", "M.T_B"}
    assert stack.height == pytest.approx(6 * 0.25)
    x, away = stack.place
    assert -20 < x < 20 and 40 < away < 70


def test_what_stands_on_a_box_comes_on_top(on_paper):
    stack = on_paper(tower()[0], STOCK).stack
    assert len(stack.patches) == 14
    assert stack.height == pytest.approx(14 * 0.25)


def test_thick_walls_touch_where_their_distance_is_their_thickness(on_paper):
    """A riser s before its wall is s sin(alpha) from its plane."""
    for depth, stock in ((10.0, STOCK), (10.0, Stock.of(400)), (5.0, STOCK)):
        touches = {touch.patches: touch.theta for touch in on_paper(boxed_step(depth), stock).clearance.touches}
        touched = touches["M.L", "S.riser"]
        assert touched == pytest.approx(2 * np.arcsin(stock.thickness / depth), abs=np.radians(0.02))


def test_a_narrow_gap_is_closed_by_thickness_long_before_the_card(on_paper):
    design = boxed_step(1.5)
    thick, thin = (on_paper(design, Stock.of(grammage)).clearance for grammage in (400, 80))
    assert thick.touches[0].patches == ("M.L", "S.riser")
    assert np.degrees(thick.touches[0].theta) == pytest.approx(2 * np.degrees(np.arcsin(0.5 / 1.5)), abs=0.1)
    assert np.degrees(thin.touches[0].theta) < 8
    assert thick.least[0] > 0 > thick.least[-1]


def test_edges_that_pass_each_other_need_no_room_for_thickness(on_paper):
    """Two boxes whose closed fronts lie 0.3 mm apart, in one plane."""
    boxes = [
        BoxFold.plain("M", CARD_PAIR, 30, 40, (-60, -30.3)),
        BoxFold.plain("N", CARD_PAIR, 30, 40, (30, 60)),
    ]
    touches = on_paper(assemble(CARD, boxes), Stock.of(400)).clearance.touches
    assert not any({touch.patches[0][0], touch.patches[1][0]} == {"M", "N"} for touch in touches)


def test_plates_that_share_a_fold_or_an_edge_from_the_start_are_no_gap(on_paper):
    run = on_paper(plain_box(), STOCK)
    assert run.clearance.touches == ()
    assert run.clearance.least.min() > -1e-6


def test_a_top_sags_as_a_beam_between_its_hinges(on_paper):
    for half_width in (30.0, 60.0):
        stock = Stock.of(160, bending=3.0)
        run = on_paper(plain_box(half_width=half_width, height=40), stock)
        unloaded = [sag for sag in run.sags if sag.load < 1e-9]
        assert unloaded
        for sag in unloaded:
            assert sag.span == pytest.approx(half_width)
            assert sag.depth == pytest.approx(5 * stock.weight * half_width**4 / (384 * 3.0), rel=1e-3)


def test_what_stands_on_a_top_bends_it_more(on_paper):
    sags = {sag.patch: sag for sag in on_paper(tower()[0], STOCK).sags}
    bare = {
        sag.patch: sag
        for sag in on_paper(assemble(CARD, [BoxFold.plain("low", CARD_PAIR, 40, 30, (-50, 50))]), STOCK).sags
    }
    for name in ("low.T_G", "low.T_B"):
        assert sags[name].load > bare[name].load
        assert sags[name].depth > 1.5 * bare[name].depth
    assert not any(name.endswith((".L", ".R")) for name in sags)


def test_sag_falls_with_the_cube_of_the_thickness(on_paper):
    box = plain_box()
    thin, thick = (on_paper(box, Stock.of(200, thickness=t)).sags[0].depth for t in (0.2, 0.4))
    assert thin / thick == pytest.approx(8, rel=1e-6)

"""Crossings: the pair, the first angle, the depth; and silence where nothing crosses."""

import numpy as np
import pytest
from folding_designs import (
    CARD,
    CARD_PAIR,
    checked,
    layered,
    leaning,
    overlapping_boxes,
    pair_inside,
    plain_box,
    tower,
    wedges,
)

from popsim.mechanisms import assemble
from popsim.mechanisms.box_fold import BoxFold
from popsim.simulation import fold_design
from popsim.simulation.collisions import find_crossings
from popsim.simulation.passing import find_passing
from popsim.simulation.piercing import find_piercings

TOLERANCE = 0.05


def crossings(design):
    sweep = fold_design(design, 90).sweep
    return {frozenset(contact.patches): contact for contact in find_crossings(sweep, TOLERANCE)}


@pytest.mark.parametrize("design", [tower()[0], wedges()[0], layered()[0]], ids=["tower", "wedges", "layered"])
def test_no_false_alarm(design):
    folding = fold_design(design, 90)
    assert find_crossings(folding.sweep, TOLERANCE) == []
    assert find_piercings(folding.sweep, TOLERANCE, folding.gaps.largest) == []
    assert find_passing(folding.sweep, list(folding.rig.turns.values()), TOLERANCE) == []


def test_boxes_whose_ranges_overlap_collide():
    found = crossings(overlapping_boxes())
    assert set(found) == {frozenset(("M.F_L", "N.B_L")), frozenset(("M.F_R", "N.B_R"))}


def test_first_angle_and_depth_of_two_end_pairs():
    """Facing folds at x = -20 + 30 cos a and 20 - 30 cos a meet where cos a = 2/3."""
    contact = crossings(overlapping_boxes())[frozenset(("M.F_L", "N.B_L"))]
    assert np.degrees(contact.first) == pytest.approx(np.degrees(2 * np.arccos(2 / 3)), abs=2.1)
    assert 1 < contact.depth < 20


def test_boxes_that_just_touch_when_closed_are_clear():
    boxes = (BoxFold.plain("M", CARD_PAIR, 30, 40, (-70, -30)), BoxFold.plain("N", CARD_PAIR, 30, 40, (30, 70)))
    assert crossings(assemble(CARD, boxes)) == {}


def test_a_v_fold_on_a_box_leans_over_its_neighbour():
    assert any({"lean", "tall"} == {name.split(".")[0] for name in pair} for pair in crossings(leaning()))


def test_a_pair_inside_the_profile_cuts_the_roof():
    found = crossings(pair_inside(0, 60))
    assert found[frozenset(("M.T_G", "M.F_L2"))].depth > 15


def test_a_fold_through_the_backbone_is_seen_though_neither_patch_crosses_it():
    sweep = fold_design(pair_inside(0, 10), 90).sweep
    assert find_crossings(sweep, TOLERANCE) == []
    (contact,) = find_piercings(sweep, TOLERANCE, 0.0)
    assert contact.patches == ("M.F_L2", "M.C")
    assert contact.depth == pytest.approx(25, abs=0.5)


def test_a_hole_lets_through_what_would_cross():
    """A window in the roof: only its rim is left to cut."""
    box = pair_inside(0, 60)
    window = ((-1.0, 0.5, 60.0), (39.5, 0.5, 60.0), (39.5, 39.5, 60.0), (-1.0, 39.5, 60.0))
    patches = tuple(
        patch.model_copy(update={"holes": (window,)}) if patch.id == "M.T_G" else patch for patch in box.patches
    )
    pair = frozenset(("M.T_G", "M.F_L2"))
    opened = crossings(checked(box.model_copy(update={"patches": patches})))
    assert opened[pair].depth < 4
    assert crossings(box)[pair].depth > 15


def test_a_crease_that_goes_the_wrong_way_cuts_the_box():
    box = plain_box()
    hinges = tuple(
        hinge.model_copy(update={"crease": (-1.0, 0.0, 0.0)})
        if set(hinge.patches) == {"M.F_L", "M.F_R"}
        else hinge
        for hinge in box.hinges
    )
    assert frozenset(("M.T_G", "M.F_L")) in crossings(checked(box.model_copy(update={"hinges": hinges})))

"""Crossings: the pair, the first angle, the depth; and silence where nothing crosses."""

from dataclasses import replace

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
from popsim.simulation.contact import contacts_of, searched_frames
from popsim.simulation.piercing import find_piercings
from popsim.simulation.search import find_contacts

TOLERANCE = 0.05


def contacts(design):
    folding = fold_design(design, 90)
    return find_contacts(folding.rig, folding.sweep, TOLERANCE, play=folding.gaps.largest, resolution=0.01)


def crossings(design):
    return {frozenset(contact.patches): contact for contact in contacts(design)}


@pytest.mark.parametrize("design", [tower()[0], wedges()[0], layered()[0]], ids=["tower", "wedges", "layered"])
def test_no_false_alarm(design):
    assert contacts(design) == ()


def test_boxes_whose_ranges_overlap_collide():
    found = crossings(overlapping_boxes())
    assert set(found) == {frozenset(("M.F_L", "N.B_L")), frozenset(("M.F_R", "N.B_R"))}


def test_first_angle_and_depth_of_two_end_pairs():
    """Facing folds at x = -20 + 30 cos a and 20 - 30 cos a meet where cos a = 2/3, and cross a little later."""
    contact = crossings(overlapping_boxes())[frozenset(("M.F_L", "N.B_L"))]
    meet = np.degrees(2 * np.arccos(2 / 3))
    late = np.degrees(2 * (np.arccos(2 / 3) - np.arccos((20 + TOLERANCE) / 30)))
    assert meet - late < np.degrees(contact.first) < meet
    assert contact.way == "closing"
    assert 1 < contact.depth < 20


@pytest.mark.parametrize("angles", [30, 45, 180])
def test_first_angle_does_not_depend_on_how_many_are_recorded(angles):
    folding = fold_design(overlapping_boxes(), angles)
    found = find_contacts(folding.rig, folding.sweep, TOLERANCE, play=0.0, resolution=0.01)
    first = crossings(overlapping_boxes())[frozenset(found[0].patches)].first
    assert np.degrees(found[0].first) == pytest.approx(np.degrees(first), abs=0.021)


def test_what_crosses_only_on_the_way_up_is_found_and_said():
    """Two boxes that never meet, but on the way up one of them is carried over to the other."""
    apart = (BoxFold.plain("M", CARD_PAIR, 10, 20, (-70, -40)), BoxFold.plain("N", CARD_PAIR, 10, 20, (40, 70)))
    folding = fold_design(assemble(CARD, apart), 30)
    poses = folding.sweep.poses.copy()
    moved = [folding.sweep.index[name] for name in folding.sweep.index if name.startswith("M.")]
    poses[40:50, moved, 0, 3] += 100.0
    strayed = replace(folding.sweep, poses=poses)
    found = find_contacts(folding.rig, strayed, TOLERANCE, play=0.0, resolution=180.0)
    assert {contact.way for contact in found} == {"opening"}
    assert {name.split(".")[0] for contact in found for name in contact.patches} == {"M", "N"}
    assert {round(np.degrees(contact.first)) for contact in found} == {60}


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
    frames = searched_frames(sweep, TOLERANCE)
    assert find_crossings(sweep, frames, TOLERANCE) == {}
    (contact,) = contacts_of(sweep, find_piercings(sweep, frames, TOLERANCE, 0.0))
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

"""Flaps folded with the design: what is in their way is found, and they give way."""

from dataclasses import replace

import numpy as np
import pytest
from shapely.geometry import box

from popsim.design import Card, Design
from popsim.gluing import find_flap_contacts, keeping_clear
from popsim.gluing.contacts import NIP
from popsim.gluing.plates import plate_id, with_flaps
from popsim.layout import Face, Flap, Layout, lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.simulation import Sweep, fold_design
from popsim.verification.random_designs import random_design

CARD = Card(x=(-60, 60), depth=90)
PAPER = 0.25
ANGLES = 30


@pytest.fixture(scope="module")
def design() -> Design:
    return assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])


@pytest.fixture(scope="module")
def layout(design: Design) -> Layout:
    return lay_out(design)


@pytest.fixture(scope="module")
def sweep(design: Design) -> Sweep:
    return fold_design(design, ANGLES).sweep


def moved(layout: Layout, joint: str, to: tuple[float, float, float, float], face: Face | None = None) -> Flap:
    """The flap of a joint, landing on the rectangle `to` (card x and y, low and high) of its page instead."""
    flap = next(flap for flap in layout.flaps if flap.joint.id == joint)
    corners = layout.parts[flap.target].flat(np.array([[to[0], to[1], 0.0], [to[2], to[3], 0.0]]))
    return replace(flap, landing=box(*corners.min(axis=0), *corners.max(axis=0)), face=face or flap.face)


def test_flaps_move_with_what_they_are_glued_to(layout: Layout, sweep: Sweep) -> None:
    folded = with_flaps(layout.parts, layout.flaps, sweep, PAPER)
    assert len(folded.design.patches) == len(sweep.design.patches) + len(layout.flaps)
    for flap in layout.flaps:
        own, target = folded.index[plate_id(flap)], folded.index[flap.target]
        assert (folded.poses[:, own] == folded.poses[:, target]).all()
        plate, patch = folded.design.patches[own], folded.design.patches[target]
        off = patch.plane.distance(plate.points)
        normal = layout.parts[flap.target].plane.normal
        assert off == pytest.approx(flap.face.value * PAPER * float(normal @ patch.plane.normal))
        assert folded.touching[own, target]
        assert folded.touching[own, folded.index[flap.carrier]]


def test_flaps_of_a_box_touch_nothing(layout: Layout, sweep: Sweep) -> None:
    assert find_flap_contacts(layout.parts, layout.flaps, sweep, PAPER) == ()


def test_a_flap_under_an_end_pair_is_in_its_way(layout: Layout, sweep: Sweep) -> None:
    """The end pair at x = 30 stands on the ground without a hinge; a flap that reaches through it is cut by it."""
    flap = moved(layout, "h1", (10.0, 5.0, 40.0, 15.0))
    (contact, *more) = find_flap_contacts(layout.parts, (flap,), sweep, PAPER)
    assert contact.other == "M1.F_L"
    assert not more
    assert np.degrees(contact.theta) > 90
    assert contact.bite == pytest.approx(5, abs=0.5)  # the middle of a flap 10 mm wide
    target = layout.parts["G"]
    for line in contact.lines:
        assert target.plane.lift(line)[:, 0].min() >= 30 - 0.1


def test_a_flap_behind_the_page_or_away_from_the_box_is_not(layout: Layout, sweep: Sweep) -> None:
    behind = moved(layout, "h1", (10.0, 5.0, 40.0, 15.0), Face.REVERSE)
    away = moved(layout, "h1", (32.0, 25.0, 50.0, 35.0))
    for flap in (behind, away):
        assert find_flap_contacts(layout.parts, (flap,), sweep, PAPER) == ()


def test_two_flaps_that_meet_in_a_fold_are_in_each_others_way(layout: Layout, sweep: Sweep) -> None:
    """Both far from the fold of the card they only lie on each other when it is closed; across it they cross."""
    ground = moved(layout, "h1", (-10.0, 20.0, 10.0, 30.0))
    backdrop = moved(layout, "h2", (-10.0, -30.0, 10.0, -20.0))
    assert find_flap_contacts(layout.parts, (ground, backdrop), sweep, PAPER) == ()
    over = replace(ground, landing=moved(layout, "h1", (-10.0, -10.0, 10.0, 10.0)).landing)
    contacts = find_flap_contacts(layout.parts, (over, backdrop), sweep, PAPER)
    assert {contact.other for contact in contacts} >= {"B"}


def test_a_layout_moves_or_cuts_flaps_that_are_in_the_way() -> None:
    design = random_design(5, mechanisms=(1, 4)).design
    sweep = fold_design(design, ANGLES).sweep
    plain = lay_out(design)
    clear = lay_out(design, in_the_way=keeping_clear(sweep, PAPER))
    before, after = (find_flap_contacts(made.parts, made.flaps, sweep, PAPER) for made in (plain, clear))
    assert before
    assert all(contact.bite > NIP for contact in before)
    assert after == ()
    assert set(clear.numbers) == set(plain.numbers)  # every joint keeps a flap

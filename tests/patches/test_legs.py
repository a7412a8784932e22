"""Plates that end above the ground show no wheels and legs that stand back beneath them."""

import numpy as np
import pytest
from patch_solids import box_of, coloured_box, joined

from popsim.design import Card
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.patches import PatchSettings, paint

CARD = Card(x=(-200, 200), depth=250)
BODY = coloured_box((-50, -30, 10), (50, 30, 40))


def outlines(*parts):
    """Patches of a box-fold around a body with other parts."""
    surface = joined(BODY, *parts)
    box = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-50, 50, 40),))
    found = paint([box], surface, {"M1": box_of(surface)}, PatchSettings(dpi=75), prints=False).shapes
    return {name.removeprefix("M1."): shape.outline for name, shape in found.items()}


def wheels(front):
    """A wheel at each side whose front lies at some x."""
    return [coloured_box((front - 12, side, 0), (front, side + 10, 10)) for side in (-30, 20)]


def test_wheels_behind_the_front_are_left_to_the_sides():
    found = outlines(*wheels(34))
    assert found["F_L"][:, 2].min() == pytest.approx(10, abs=0.3)
    assert found["L"][:, 2].min() == 0


def test_wheels_at_the_front_are_shown():
    assert outlines(*wheels(41))["F_L"][:, 2].min() == 0


def test_a_wall_beneath_a_projecting_storey_is_no_leg():
    assert outlines(coloured_box((-50, -30, 0), (41, 30, 10)))["F_L"][:, 2].min() == 0


def test_a_wing_beneath_the_eaves_is_no_leg():
    body = [coloured_box((-50, -30, 36), (50, 30, 40)), coloured_box((-50, -18, 0), (50, 18, 40))]
    wings = [coloured_box((-33, side, 0), (33, side + 12, 36)) for side in (-30, 18)]
    surface = joined(*body, *wings)
    box = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-50, 50, 40),))
    found = paint([box], surface, {"M1": box_of(surface)}, PatchSettings(dpi=75), prints=False).shapes
    front = found["M1.F_L"].outline
    assert np.ptp(front[:, 1]) == pytest.approx(30, abs=0.3)
    assert front[front[:, 1] > 20, 2].min() == 0


def test_an_axle_that_does_not_reach_the_ground_is_left_out():
    axle = coloured_box((28, -30, 4), (34, 30, 10))
    assert outlines(axle)["F_L"][:, 2].min() == pytest.approx(10, abs=0.3)


def test_what_stands_back_on_top_of_nearer_parts_is_shown():
    surface = joined(coloured_box((-50, -30, 0), (50, 30, 20)), coloured_box((-50, -30, 20), (42, 30, 40)))
    box = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-50, 50, 40),))
    found = paint([box], surface, {"M1": box_of(surface)}, PatchSettings(dpi=75), prints=False).shapes
    front = found["M1.F_L"].outline
    assert np.ptp(front[:, 2]) == pytest.approx(40, abs=0.3)

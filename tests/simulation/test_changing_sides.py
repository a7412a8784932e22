"""Plates that pass through each other all at once, parallel, so that none reaches through another at any angle."""

import numpy as np
import pytest
from folding_designs import CARD, CARD_PAIR, checked

from popsim.design import Design, Hinge, Patch
from popsim.mechanisms import assemble
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation import fold_design
from popsim.simulation.search import find_contacts
from popsim.verification import verify

HALF_BASE, SLOPE, RIDGE = 20.0, 25.0, 15.0
"""mm; of the tent, whose ridge rises from 15 to 45 mm."""


def lift(box: float, tongue: tuple[float, float] = (2.0, 9.0)) -> Design:
    """A shelf on the ridge of a tent rises past a shelf on the roof of a box that is `box` mm high.

    Both stay parallel to the ground, and reach over one place from either side, the one on the tent with a tongue
    that lies between two distances from the central fold.
    """
    mechanisms = (
        BoxFold("M", CARD_PAIR, 10, (Top(40, 60, box),), (EndPair(60, 0, box, 1),)),
        TentFold("t", CARD_PAIR, (-40, -20), HALF_BASE, RIDGE),
    )
    design = assemble(CARD, mechanisms)
    roof = [(40, 0), (60, 0), (60, 10), (40, 10), (40, 9), (-15, 9), (-15, 2), (40, 2)]
    low, high = tongue
    shelf = [(-40, 0), (-20, 0), (-20, low), (20, low), (20, high), (-20, high), (-20, 30), (-40, 30)]
    patches = [
        patch.model_copy(update={"outline": raised(roof, box)}) if patch.id == "M.T_G" else patch
        for patch in design.patches
    ]
    ends = (-40.0, -20.0)
    leg = tuple(
        (x, y, z)
        for x, y, z in zip((*ends, *ends[::-1]), (40.0, 40.0, 20.0, 20.0), (0, 0, RIDGE, RIDGE), strict=True)
    )
    patches += [Patch(id="shelf", outline=raised(shelf, RIDGE)), Patch(id="leg", outline=leg)]
    hinges = [
        hinge("a", ("G", "leg"), 40.0, 0.0),
        hinge("b", ("leg", "shelf"), 20.0, RIDGE),
        hinge("c", ("t.T_3", "shelf"), 0.0, RIDGE),
    ]
    bare = tuple(patch.model_copy(update={"mechanism": None}) for patch in patches)
    changed = {"patches": bare, "hinges": (*design.hinges, *hinges), "mechanisms": ()}
    return checked(design.model_copy(update=changed))


def raised(points: list[tuple[float, float]], z: float) -> tuple[tuple[float, float, float], ...]:
    return tuple((float(x), float(y), z) for x, y in points)


def hinge(name: str, patches: tuple[str, str], y: float, z: float) -> Hinge:
    return Hinge(id=name, patches=patches, axis=((-40.0, y, z), (-20.0, y, z)), kind="glue")


def meeting(height: float) -> float:
    """Fold angle at which the ridge, at t1 cos a + sqrt(t3^2 - t1^2 sin^2 a), is as high as the box, degrees."""
    cosine = (height**2 + HALF_BASE**2 - SLOPE**2) / (2 * HALF_BASE * height)
    return float(np.degrees(2 * np.arccos(cosine)))


@pytest.mark.parametrize("height", [20, 30, 40])
def test_shelves_that_pass_through_each_other_are_refused_where_they_meet(height: float) -> None:
    verdict = verify(lift(height))
    assert not verdict.passed
    assert verdict.finding("clear").simulation is False
    (contact,) = [each for each in verdict.evidence.contacts if each.way == "closing"]
    assert contact.patches == ("M.T_G", "shelf")
    assert np.degrees(contact.first) == pytest.approx(meeting(height), abs=0.8)
    assert contact.depth == pytest.approx(3.5, abs=0.2)


@pytest.mark.parametrize("angles", [45, 90, 180])
def test_they_are_found_between_recorded_angles(angles: int) -> None:
    folding = fold_design(lift(30), angles)
    found = find_contacts(folding.rig, folding.sweep, 0.05, play=folding.gaps.largest, resolution=0.01)
    assert {each.patches for each in found} == {("M.T_G", "shelf")}


def test_a_shelf_that_never_gets_so_high_is_no_alarm() -> None:
    assert verify(lift(60)).passed


def test_a_shelf_that_passes_beside_the_other_is_no_alarm() -> None:
    assert verify(lift(30, (10.0, 18.0))).passed
    assert verify(lift(30, (9.02, 18.0))).passed
    assert not verify(lift(30, (8.5, 18.0))).passed

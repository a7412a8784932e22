"""Patches that turn about one line without a hinge between them, and pass through each other."""

from collections.abc import Iterator

import numpy as np
import pytest
from folding_designs import checked, overlapping_boxes, plain_box, tower

from popsim.design import Design, Hinge, Patch
from popsim.simulation import fold_design
from popsim.simulation.neighbours import companions, hinge_lines, touching
from popsim.simulation.passing import passing_depths, turns_that_pass
from popsim.simulation.turning import free_turns
from popsim.verification import verify

LINE = 40.0
"""mm from the central fold: where both legs stand on the ground."""

Point = tuple[float, float, float]


def legs(tongue: float) -> Design:
    """Two shelves carried by tents, one with slopes alike and one with others, each on a leg of its own as well.

    Both legs stand on one line of the ground, some way apart along it, and reach for each other with tongues that
    overlap by twice `tongue` mm. They lean alike when open, and the leg of the lopsided tent falls faster.
    """
    box = plain_box()
    patches, hinges = list(box.patches[:2]), list(box.hinges[:1])
    for name, feet, slopes, x, tip in (
        ("a", (20.0, 20.0), (24.154, 24.154), (-60.0, -30.0), tongue),
        ("b", (10.0, 30.0), (45.0, 25.0), (30.0, 60.0), -tongue),
    ):
        ridge = apex(feet, slopes)
        top = ridge[0] + LINE - feet[0], ridge[1]
        for role, outline in {
            "ground": strip(x, (feet[0], 0.0), ridge),
            "back": strip(x, (-feet[1], 0.0), ridge),
            "shelf": strip(x, ridge, top),
            "leg": with_tongue(strip(x, (LINE, 0.0), top), tip),
        }.items():
            patches.append(Patch(id=f"{name}.{role}", outline=outline))
        hinges += joints(name, x, feet, ridge, top)
    return checked(box.model_copy(update={"patches": tuple(patches), "hinges": tuple(hinges), "mechanisms": ()}))


def apex(feet: tuple[float, float], slopes: tuple[float, float]) -> tuple[float, float]:
    """Ridge (y, z) of two slopes on the open card."""
    apart = sum(feet)
    inward = (apart**2 + slopes[0] ** 2 - slopes[1] ** 2) / (2 * apart)
    return feet[0] - inward, float(np.sqrt(slopes[0] ** 2 - inward**2))


def strip(x: tuple[float, float], low: tuple[float, float], high: tuple[float, float]) -> tuple[Point, ...]:
    return ((x[0], *low), (x[1], *low), (x[1], *high), (x[0], *high))


def with_tongue(leg: tuple[Point, ...], tip: float) -> tuple[Point, ...]:
    """A leg with a tongue between 8 and 16 mm from its line that ends at x = `tip`."""
    foot, top = np.array(leg[1][1:]), np.array(leg[2][1:])
    near, far = (foot + (top - foot) / np.linalg.norm(top - foot) * length for length in (8.0, 16.0))
    right = tip > leg[1][0]
    side = leg[1][0] if right else leg[0][0]
    edge = [(side, *near), (tip, *near), (tip, *far), (side, *far)]
    ring = [*leg[:2], *edge, *leg[2:]] if right else [*leg, *edge[::-1]]
    return tuple((float(a), float(b), float(c)) for a, b, c in ring)


def joints(
    name: str,
    x: tuple[float, float],
    feet: tuple[float, float],
    ridge: tuple[float, float],
    top: tuple[float, float],
) -> Iterator[Hinge]:
    for first, second, at in (
        ("G", f"{name}.ground", (feet[0], 0.0)),
        ("B", f"{name}.back", (-feet[1], 0.0)),
        (f"{name}.ground", f"{name}.back", ridge),
        (f"{name}.ground", f"{name}.shelf", ridge),
        (f"{name}.shelf", f"{name}.leg", top),
        ("G", f"{name}.leg", (LINE, 0.0)),
    ):
        axis = ((x[0], *at), (x[1], *at))
        yield Hinge(id=f"{first}-{second}", patches=(first, second), axis=axis, kind="glue")


def test_legs_on_one_line_that_pass_each_other_are_refused() -> None:
    verdict = verify(legs(15))
    assert not verdict.passed
    assert [finding.aspect for finding in verdict.findings if finding.simulation is False] == ["clear"]
    contact = verdict.evidence.contacts[0]
    assert contact.patches == ("a.leg", "b.leg")
    assert 150 < np.degrees(contact.first) < 180
    assert 1 < contact.depth < 16


def test_legs_that_do_not_reach_each_other_are_no_alarm() -> None:
    assert verify(legs(-1)).passed


def test_companions_share_a_line_overlap_along_it_and_have_no_hinge() -> None:
    design = legs(15)
    assert {frozenset(hinge.patches) for hinge in companions(design, hinge_lines(design))} >= {
        frozenset(("a.leg", "b.leg"))
    }
    together, place = (
        touching(design, hinge_lines(design)),
        {patch.id: k for k, patch in enumerate(design.patches)},
    )
    hinged = {frozenset(hinge.patches) for hinge in design.hinges}
    for hinge in companions(design, hinge_lines(design)):
        first, second = (place[name] for name in hinge.patches)
        assert together[first, second]
        assert frozenset(hinge.patches) not in hinged
    apart = [hinge.patches for hinge in companions(overlapping_boxes(), hinge_lines(overlapping_boxes()))]
    assert not any({name[0] for name in pair} == {"M", "N"} for pair in apart)


@pytest.mark.parametrize("design", [plain_box(), tower()[0]], ids=["box", "tower"])
def test_companions_of_sound_designs_stay_on_their_sides(design: Design) -> None:
    folding = fold_design(design, 60)
    turns = list(free_turns(design, folding.sweep.companions).values())
    assert turns
    assert turns_that_pass(folding.sweep) == []
    assert passing_depths(folding.sweep, turns).max() < 0.01

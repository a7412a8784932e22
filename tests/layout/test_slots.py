"""Patches that pass through each other: slots, and the flaps in them."""

import numpy as np
import pytest
import shapely
from shapely.geometry import Polygon

from popsim.design import Card, Design, Hinge, Patch
from popsim.design.rules import check_rules
from popsim.geometry.flat import move_shape
from popsim.layout import Crease, Face, Layout, LayoutError, lay_out

GROUND = Patch(id="G", outline=((-60, 0, 0), (60, 0, 0), (60, 90, 0), (-60, 90, 0)))
BACKDROP = Patch(id="B", outline=((-60, -90, 0), (60, -90, 0), (60, 0, 0), (-60, 0, 0)))
CENTRAL = Hinge(id="h0", patches=("G", "B"), axis=((-60, 0, 0), (60, 0, 0)), kind="central", crease=(0, 0, -1))
SHELF = Patch(id="S", outline=((-15, 20, 15), (55, 20, 15), (55, 60, 15), (-15, 60, 15)))


def through(wall: list[tuple[float, float]], shelf: Patch = SHELF, reach: tuple[float, float] = (0, 40)) -> Design:
    """A wall of an outline (x, z) on the ground at y = 40, and a shelf at z = 15 that it passes through."""
    standing = Patch(id="W", outline=tuple((x, 40.0, z) for x, z in wall))
    feet = Hinge(id="g", patches=("G", "W"), axis=((0, 40, 0), (40, 40, 0)), kind="glue")
    line = Hinge(id="s", patches=("W", "S"), axis=((reach[0], 40, 15), (reach[1], 40, 15)), kind="glue")
    made = Design(
        card=Card(x=(-60, 60), depth=90),
        patches=(GROUND, BACKDROP, standing, shelf),
        hinges=(CENTRAL, feet, line),
    )
    check_rules(made)
    return made


PLAIN = [(0.0, 0.0), (40.0, 0.0), (40.0, 35.0), (0.0, 35.0)]


@pytest.fixture(scope="module")
def layout() -> Layout:
    return lay_out(through(PLAIN))


def test_the_wider_part_gets_the_slot(layout: Layout) -> None:
    (flap,) = (flap for flap in layout.flaps if flap.joint.id == "s")
    assert (flap.carrier, flap.target) == ("S", "W")
    assert flap.opening is not None
    play = layout.settings.clearance
    low, high = np.array(flap.opening.bounds[:2]), np.array(flap.opening.bounds[2:])
    assert sorted(high - low) == pytest.approx([5.3, 40 + 2 * play])
    assert flap.crease is not Crease.NONE
    assert flap.landing.within(layout.parts["W"].polygon)


def test_the_opening_is_cut_out_and_the_flap_hangs_in_it_by_its_crease(layout: Layout) -> None:
    piece = layout.piece_of["S"]
    (flap,) = piece.flaps
    (hole,) = piece.outline.interiors
    motion = piece.motions["S"]
    assert flap.opening is not None
    cut = move_shape(motion, flap.opening.difference(flap.polygon))
    assert Polygon(hole).symmetric_difference(cut).area < 0.2
    (crease,) = (fold for fold in piece.folds if fold.joint.id == "s")
    assert shapely.LineString(crease.ends).distance(move_shape(motion, flap.polygon)) < 1e-6
    expected = layout.parts["S"].polygon.area - flap.opening.area + flap.polygon.area
    assert piece.outline.area == pytest.approx(expected, abs=0.2)


def test_the_guest_fits_through_the_opening(layout: Layout) -> None:
    """What of the wall lies in the plane of the shelf lies in the opening, beside the flap folded up."""
    (flap,) = (flap for flap in layout.flaps if flap.joint.id == "s")
    shelf = layout.parts["S"]
    assert flap.opening is not None
    passing = shapely.LineString(shelf.flat(np.array([[0.0, 40, 15], [40, 40, 15]])))
    assert passing.within(flap.opening.buffer(1e-6))


def test_the_flap_lies_on_the_side_of_its_opening(layout: Layout) -> None:
    (flap,) = (flap for flap in layout.flaps if flap.joint.id == "s")
    shelf, wall = layout.parts["S"], layout.parts["W"]
    assert flap.opening is not None
    opened = shelf.plane.lift(np.array(flap.opening.centroid.coords[0]))
    side = float(wall.plane.distance(opened))
    assert flap.face is (Face.PRINTED if side > 0 else Face.REVERSE)


@pytest.mark.parametrize("flipped", [False, True])
def test_a_guest_too_wide_on_one_side_goes_in_from_the_other(flipped: bool) -> None:
    wide = [(0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (45.0, 20.0), (45.0, 35.0), (0.0, 35.0)]
    foot = [(-5.0, 0.0), (45.0, 0.0), (45.0, 10.0), (40.0, 10.0), (40.0, 35.0), (0.0, 35.0), (0, 10.0), (-5, 10.0)]
    layout = lay_out(through(foot if flipped else wide))
    assert sum(flap.opening is not None for flap in layout.flaps) == 1


def test_a_guest_too_wide_on_both_sides_is_refused() -> None:
    hourglass = [(-5, 0), (45, 0), (45, 10), (40, 10), (40, 20), (45, 20), (45, 35), (0, 35), (0, 10), (-5, 10)]
    with pytest.raises(LayoutError, match="W and S"):
        lay_out(through([(float(x), float(z)) for x, z in hourglass]))


def test_a_slot_that_would_cut_the_rim_is_refused() -> None:
    narrow = Patch(id="S", outline=((-15, 39, 15), (55, 39, 15), (55, 41, 15), (-15, 41, 15)))
    with pytest.raises(LayoutError, match="no flap fits"):
        lay_out(through(PLAIN, shelf=narrow))

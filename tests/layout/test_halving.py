"""Patches that would go onto a sheet whole are divided where that fills the sheets, and only there."""

from functools import cache, partial
from types import SimpleNamespace

import numpy as np
import pytest
from hand_made import card_with, shares, wall
from shapely.geometry import box

from popsim.design import Design, Hinge, Patch
from popsim.geometry.flat import move_shape
from popsim.layout import Layout, LayoutSettings, lay_out
from popsim.layout.improving import improvements
from popsim.layout.split import NO_STRIP, Hints, halved
from popsim.layout.waste import WELL_FILLED, Waste
from popsim.stock import parse_stock

LONG, DEEP, SIDE, BAR = 180.0, 60.0, 170.0, 14.0


def framed_card(count: int, *more: tuple[Patch, Hinge]) -> Design:
    """A card with upright frames one behind the other, and more; no two frames go onto one A4."""
    half, inner = SIDE / 2, SIDE / 2 - BAR
    corners = ((-inner, BAR), (inner, BAR), (inner, SIDE - BAR), (-inner, SIDE - BAR))
    places = [10.0 + 8 * k for k in range(count)]
    frames = [wall(f"W{k}", y, half, SIDE, (tuple((x, y, z) for x, z in corners),)) for k, y in enumerate(places)]
    return card_with([*frames, *more], LONG / 2, DEEP)


@cache
def laid(count: int) -> Layout:
    """That many frames, divided where it helps."""
    return lay_out(framed_card(count))


def filled(layout: Layout) -> np.ndarray:
    """How full the sheets are, the emptiest first."""
    return np.sort(shares(layout))


@pytest.mark.parametrize(("count", "sheets"), [(1, (2, 1)), (2, (2, 2)), (3, (3, 2)), (4, (4, 2))])
def test_frames_are_divided_to_share_sheets(count: int, sheets: tuple[int, int]) -> None:
    """A sheet is saved, or all but the last are well filled, with a flap under each seam."""
    design = framed_card(count)
    whole = lay_out(design, settings=LayoutSettings(split=False))
    layout = laid(count)
    assert not whole.divided
    assert filled(whole)[1:].min() < WELL_FILLED
    assert (whole.sheet_count, layout.sheet_count) == sheets
    assert layout.sheet_count < whole.sheet_count or filled(layout)[1:].min() >= WELL_FILLED
    assert layout.divided.keys() <= {patch.id for patch in design.popup_patches}
    for name in layout.divided:
        own = [part.polygon for part in layout.parts.values() if part.patch.id == name]
        assert sum(polygon.area for polygon in own) == pytest.approx(SIDE**2 - (SIDE - 2 * BAR) ** 2)
    seams = {joint.id for joint in layout.joints if joint.hinge is None}
    assert len(seams) >= sum(layout.divided.values()) - len(layout.divided) > 0
    assert seams <= {flap.joint.id for flap in layout.flaps}


def test_no_more_are_divided_than_help() -> None:
    assert len(laid(2).divided) == 1
    assert not lay_out(framed_card(1), paper="A3").divided


def test_what_fills_no_sheet_stays_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """A patch divided without use is a joint for nothing."""
    monkeypatch.setattr("popsim.layout.halving.HALVED", 0)
    design = framed_card(3)
    layout = lay_out(design)
    assert not layout.divided
    assert filled(layout)[1:].min() < WELL_FILLED


@pytest.mark.parametrize("axis", [0, 1])
def test_halves_leave_no_strip(axis: int) -> None:
    shape = box(0, 0, 100, 90)
    first, second = halved(shape, axis, Hints([], []), 0.0)
    assert first.area + second.area == pytest.approx(shape.area)
    assert min(part.bounds[2 + axis] - part.bounds[axis] for part in (first, second)) >= NO_STRIP - 1e-9
    assert not halved(box(0, 0, 2 * NO_STRIP, 2 * NO_STRIP), axis, Hints([], []), 0.5)


def test_edges_are_cut_back_alike_whether_patches_are_divided_or_not() -> None:
    """The frames butt against a wall; what is divided is what was designed, and only then cut back."""
    x = SIDE / 2
    foot = ((x, 5.0, 0.0), (x, 45.0, 0.0))
    side = Patch(id="S", outline=(*foot, (x, 45.0, 60.0), (x, 5.0, 60.0)))
    design = framed_card(2, (side, Hinge(id="h-S", patches=("G", "S"), axis=foot, kind="glue")))
    stock = parse_stock("60gsm")
    whole, layout = (lay_out(design, settings=LayoutSettings(split=split, stock=stock)) for split in (False, True))
    assert layout.divided
    for name in layout.divided:
        cut_back = whole.parts[name].polygon.area
        assert cut_back < SIDE**2 - (SIDE - 2 * BAR) ** 2 - 1
        own = [part.polygon.area for part in layout.parts.values() if part.patch.id == name]
        assert sum(own) == pytest.approx(cut_back, abs=1e-6)


def test_pieces_lie_on_their_sheets() -> None:
    layout = laid(3)
    for placement in layout.placements:
        assert box(0, 0, 210, 297).contains(move_shape(placement.motion, placement.piece.outline))


@pytest.mark.parametrize(
    ("lacking", "placed", "taken"),
    [
        ([0.1, 0.0, 0.0], ["a", "b"], "b"),
        ([0.1, 0.05, 0.2], ["a", "b", "c"], "b"),
        ([0.4, 0.4, 0.4], ["a", "b", "c"], "before"),
    ],
)
def test_of_changes_the_first_that_leaves_nothing_lacking_is_taken_else_the_best(
    lacking: list[float], placed: list[str], taken: str
) -> None:
    def laid(name: str, short: float) -> SimpleNamespace:
        return SimpleNamespace(name=name, waste=lambda room: Waste(3, short, 0.5, -1.0, ()))

    short, asked = dict(zip("abc", lacking, strict=True)), []

    def place(name: str) -> SimpleNamespace:
        asked.append(name)
        return laid(name, short[name])

    changes = [partial(SimpleNamespace, outlines=name) for name in "abc"]
    estimator = SimpleNamespace(waste=lambda name: Waste(3, 0.0, 0.5, -1.0, ()))
    before = laid("before", 0.4)
    found = improvements(
        before,
        lambda _: changes,
        lambda made: place(made.outlines),
        estimator,
        (200.0, 300.0),
        most=1,
    )
    *_, last = before, *found
    assert asked == placed
    assert last.name == taken

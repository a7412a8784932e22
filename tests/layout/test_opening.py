"""Folds are opened where that saves sheets, and only there."""

import numpy as np
import pytest
from hand_made import card_with, shares, wall

from popsim.design import Design, Hinge, Patch
from popsim.layout import Layout, LayoutError, LayoutSettings, find_paper, lay_out
from popsim.layout.filling import Place
from popsim.layout.laid import Laid, Planned
from popsim.layout.nesting import Estimator
from popsim.layout.nets import Net
from popsim.layout.opening import with_opened_folds
from popsim.layout.waste import WELL_FILLED, waste_of
from popsim.verification.random_designs import random_design

LONG, DEEP = 240.0, 50.0


def walled_card(*more: tuple[Patch, Hinge]) -> Design:
    """A card and two walls of which no two go onto one A4; half the card goes beside either wall."""
    walls = [wall("W1", 30, LONG / 2, 100), wall("W2", 10, 60, 100), *more]
    return card_with(walls, LONG / 2, DEEP)


def test_a_card_is_cut_at_its_fold_to_save_a_sheet() -> None:
    layout = lay_out(walled_card(), paper="A4")
    assert layout.sheet_count == 2
    assert {frozenset(piece.motions) for piece in layout.pieces} == {
        frozenset({name}) for name in ("G", "B", "W1", "W2")
    }
    assert "h0" in {flap.joint.id for flap in layout.flaps}


def test_it_stays_in_one_piece_where_there_is_room() -> None:
    layout = lay_out(walled_card(), paper="A3")
    assert layout.sheet_count == 1
    assert {"G", "B"} in [set(piece.motions) for piece in layout.pieces]


@pytest.mark.parametrize(("share", "lacking"), [(WELL_FILLED, 0.0), (WELL_FILLED - 0.1, 0.1)])
def test_what_sheets_but_the_last_lack(share: float, lacking: float) -> None:
    waste = waste_of([1.0, share, 0.1], [0, 1, 2])
    assert waste.sheets == 3
    assert waste.lacking == pytest.approx(lacking)
    assert waste.emptiest == ((2, 1) if lacking else (2,))


def planned(layout: Layout) -> Planned:
    """What a layout was made of."""
    nets = tuple(
        Net(
            piece.motions,
            tuple(dict.fromkeys(f.joint for f in piece.folds if f.joint.id not in layout.numbers)),
        )
        for piece in layout.pieces
    )
    return Planned(layout.parts, layout.joints, nets, layout.flaps, layout.pieces)


@pytest.mark.parametrize(("effort", "expected"), [(1, [{"h0"}]), (-1, [])])
def test_folds_on_sheets_that_are_well_filled_are_tried_where_no_others_help(
    monkeypatch: pytest.MonkeyPatch, effort: int, expected: list[set[str]]
) -> None:
    """Beside the first wall, which lies alone, there is room for half of the card, which lies elsewhere."""
    monkeypatch.setattr("popsim.layout.opening.EFFORT", effort)
    settings = LayoutSettings()
    room = settings.area(find_paper("A4"))
    whole = planned(lay_out(walled_card(wall("W3", 20, 60, 90)), paper="A3"))
    sheets = {"G": 0, "W2": 0, "W1": 1, "W3": 2}
    laid = Laid(whole, tuple(Place(sheets[next(iter(net.motions))], np.eye(3)) for net in whole.nets))
    assert laid.waste(room).emptiest == (2, 1)
    asked = []

    def plan(divisions: tuple[()], barred: frozenset[str]) -> Planned:
        assert not divisions
        asked.append(set(barred))
        raise LayoutError("no room for flaps")

    estimator = Estimator(room, settings.apart, settings.grain)
    opened = with_opened_folds(plan, lambda _: laid, laid, estimator, room, settings)
    assert opened is laid
    assert [barred & {"h0"} for barred in asked] == expected


@pytest.mark.parametrize(("seed", "paper"), [(9, "A5"), (49, "A4")])
def test_what_is_opened_stays_as_estimated(monkeypatch: pytest.MonkeyPatch, seed: int, paper: str) -> None:
    """One net falls into two, and neither grows together with anything again; sheets are well filled then."""
    design = random_design(seed, mechanisms=(1, 3)).design
    layout = lay_out(design, paper=paper)
    monkeypatch.setattr("popsim.layout.opening.OPENINGS", 0)
    before = {frozenset(piece.motions) for piece in lay_out(design, paper=paper).pieces}
    after = {frozenset(piece.motions) for piece in layout.pieces}
    first, second = after - before
    assert before - after == {first | second}
    assert np.sort(shares(layout))[1:].min() >= WELL_FILLED

"""Folds are opened where that saves sheets, and only there."""

import pytest

from popsim.design import Card, Design, Hinge, Patch
from popsim.design.rules import check_rules
from popsim.layout import lay_out
from popsim.layout.waste import WELL_FILLED, waste_of

LONG, DEEP = 240.0, 50.0


def page(name: str, low: float, high: float) -> Patch:
    x = LONG / 2
    return Patch(id=name, outline=((-x, low, 0), (x, low, 0), (x, high, 0), (-x, high, 0)))


def wall(name: str, y: float, half: float, high: float) -> tuple[Patch, Hinge]:
    """An upright rectangle that is glued to the ground."""
    foot = ((-half, y, 0.0), (half, y, 0.0))
    patch = Patch(id=name, outline=(*foot, (half, y, high), (-half, y, high)))
    return patch, Hinge(id=f"h-{name}", patches=("G", name), axis=foot, kind="glue")


def walled_card() -> Design:
    """A card and two walls of which no two go onto one A4; half the card goes beside either wall."""
    walls = [wall("W1", 30, LONG / 2, 100), wall("W2", 10, 60, 100)]
    axis = ((-LONG / 2, 0.0, 0.0), (LONG / 2, 0.0, 0.0))
    central = Hinge(id="h0", patches=("G", "B"), axis=axis, kind="central", crease=(0.0, 0.0, -1.0))
    design = Design(
        card=Card(x=(-LONG / 2, LONG / 2), depth=DEEP),
        patches=(page("G", 0, DEEP), page("B", -DEEP, 0), *(patch for patch, _ in walls)),
        hinges=(central, *(hinge for _, hinge in walls)),
    )
    check_rules(design)
    return design


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

"""What thick paper changes: clearances, edges that butt against others, creases."""

import numpy as np
import pytest
import shapely

from popsim.design import Card, Design
from popsim.layout import LayoutSettings, draw_sheets, lay_out
from popsim.layout.perforation import DASHES, perforation
from popsim.layout.sheet import Line, Role, Text
from popsim.layout.thickness import KNIFE, USUAL
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.stock import Stock

BOARD = Stock.of(400, thickness=0.5)
CARTRIDGE = Stock.of(160)


def on(stock: Stock | None) -> LayoutSettings:
    return LayoutSettings(stock=stock)


def test_flaps_keep_the_thickness_of_the_paper_off_the_rim() -> None:
    assert on(None).clearance == KNIFE + USUAL
    assert on(BOARD).clearance == KNIFE + 0.5
    # walls that end 0.2 mm before the rim of the ground
    card = Card(x=(-30, 30), depth=90)
    tight = assemble(card, [BoxFold.plain("M1", card_pair(card), 20, 30, (-29.8, 29.8))])
    for stock in (None, BOARD):
        layout = lay_out(tight, settings=on(stock))
        for flap in layout.flaps:
            target = layout.parts[flap.target]
            own = shapely.LineString(target.flat(flap.joint.stretches[flap.stretch])).buffer(0.3)
            rim = target.polygon.exterior.difference(own)
            assert flap.landing.distance(rim) >= on(stock).clearance - 0.01  # round corners are polygons


def test_free_edges_that_butt_end_half_the_thickness_short(box: Design) -> None:
    plain, thick = lay_out(box), lay_out(box, settings=on(BOARD))
    spine, cut = (layout.parts["M1.C"].polygon for layout in (plain, thick))
    # the backbone is held below and above; its two ends, 30 high, butt against the end pairs
    assert np.ptp(np.array(spine.exterior.coords)[:, 0]) == pytest.approx(60)
    assert np.ptp(np.array(cut.exterior.coords)[:, 0]) == pytest.approx(60 - 0.5)
    # so do the tops, on two sides of 60 x 20, and the end pairs above and below
    for name in ("M1.T_G", "M1.F_L"):
        before, after = (layout.parts[name].polygon for layout in (plain, thick))
        assert before.area - after.area == pytest.approx(0.25 * 20 * 2, rel=0.05)
    for name in ("M1.L", "M1.R"):
        assert thick.parts[name].polygon.equals(plain.parts[name].polygon)


def test_without_a_stock_patches_are_as_designed(box: Design) -> None:
    for name, part in lay_out(box).parts.items():
        patch = box.patch_by_id[name]
        assert part.polygon.area == pytest.approx(patch.plane.polygon(patch.points).area)


@pytest.mark.parametrize(
    ("stock", "word"), [(Stock.of(80), "without scoring"), (CARTRIDGE, "score"), (BOARD, "cut")]
)
def test_sheets_say_how_to_prepare_creases(box: Design, stock: Stock, word: str) -> None:
    for sheet in draw_sheets(lay_out(box, settings=on(stock))):
        assert any(stock.name in mark.text and word in mark.text for mark in sheet.marks if isinstance(mark, Text))


def test_creases_of_board_are_perforated(box: Design) -> None:
    plain, board = (draw_sheets(lay_out(box, settings=on(stock))) for stock in (CARTRIDGE, BOARD))
    for role in (Role.MOUNTAIN, Role.VALLEY):
        lines, cuts = (
            [
                np.ptp(mark.points, axis=0).max()
                for sheet in sheets
                for mark in sheet.of(role)
                if isinstance(mark, Line)
            ]
            for sheets in (plain, board)
        )
        assert len(cuts) > 3 * len(lines)
        assert max(cuts) < 2 * DASHES[role][0]


def test_a_perforation_has_bridges_at_both_ends() -> None:
    cut, left = DASHES[Role.VALLEY]
    lines = list(perforation(Role.VALLEY, np.array([[0.0, 0.0], [20.0, 0.0]])))
    ends = np.concatenate([line.points[:, 0] for line in lines])
    assert ends[0] == pytest.approx(left)
    assert ends[-1] == pytest.approx(20 - left)
    assert (np.diff(ends)[1::2] == pytest.approx(left)) and np.diff(ends)[::2].min() >= cut - 1e-9

"""Patches larger than the sheet are divided, or refused with the scale that fits."""

import re

import pytest
import shapely

from popsim.design import Card
from popsim.layout import LayoutError, LayoutSettings, lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold


def scaled(factor: float):
    card = Card(x=(-160 * factor, 160 * factor), depth=200 * factor)
    box = BoxFold.plain("M1", card_pair(card), 40 * factor, 60 * factor, (-100 * factor, 100 * factor))
    return assemble(card, [box])


def test_parts_cover_the_patch_and_hold_together() -> None:
    layout = lay_out(scaled(1.0))
    for name in ("G", "B"):
        own = [part for part in layout.parts.values() if part.patch.id == name]
        assert len(own) == 2
        assert shapely.unary_union([part.polygon for part in own]).area == pytest.approx(320 * 200)
        assert sum(part.polygon.area for part in own) == pytest.approx(320 * 200)
        seams = [j for j in layout.joints if j.hinge is None and set(j.parts) == {part.id for part in own}]
        assert len(seams) == 1
        assert seams[0].id in layout.numbers


def test_without_dividing_the_scale_that_fits_is_stated_and_true() -> None:
    whole = LayoutSettings(split=False)
    with pytest.raises(LayoutError, match="scale the design by") as error:
        lay_out(scaled(1.0), settings=whole)
    factor = float(re.search(r"scale the design by ([0-9.]+)", str(error.value))[1])
    assert 0.4 < factor < 1
    assert lay_out(scaled(factor), settings=whole).sheet_count > 0
    with pytest.raises(LayoutError):
        lay_out(scaled(factor + 0.002), settings=whole)


def test_larger_paper_needs_no_seam() -> None:
    layout = lay_out(scaled(1.0), paper="A2")
    assert not [joint for joint in layout.joints if joint.hinge is None]


def test_a_poster_is_refused() -> None:
    with pytest.raises(LayoutError, match="parts"):
        lay_out(scaled(6.0), paper="A5")


def test_parts_go_onto_the_sheet_with_the_flaps_of_all_their_seams() -> None:
    layout = lay_out(scaled(0.5), paper="100x110mm")
    assert {"G/3", "B/3"} <= layout.parts.keys()
    assert len(layout.placements) == len(layout.pieces)


def test_sheets_too_narrow_for_seams_are_refused() -> None:
    with pytest.raises(LayoutError, match=r"no room for their flaps; scale the design by 0\.\d+ or less"):
        lay_out(scaled(1.0), paper="50x200mm", settings=LayoutSettings(margin=12.0))

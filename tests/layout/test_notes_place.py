"""Notes stand where there is room, and nowhere else."""

from functools import cache

import pytest
import shapely

from popsim.geometry.flat import move_shape
from popsim.layout import Layout, draw_sheets, lay_out
from popsim.layout.notes import HEADING, LEADING, SIZE, notes_place
from popsim.layout.sheet import Sheet, Text
from popsim.verification.random_designs import random_design

SHORT = ("Colour the back of the fin.",)
LONG = tuple(f"{number} things are to be looked at before this can be called done." for number in range(60))


def written(sheet: Sheet) -> list[Text]:
    return [mark for mark in sheet.marks if isinstance(mark, Text)]


@cache
def laid(seed: int) -> Layout:
    return lay_out(random_design(seed, mechanisms=(1, 6)).design)


@pytest.mark.parametrize("seed", [0, 1, 2, 3, 4, 7])
def test_notes_cover_no_piece(seed: int) -> None:
    layout = laid(seed)
    place = notes_place(layout, SHORT)
    assert place is not None
    lines = 2 + max(1, round(60 / place.width))
    box = shapely.box(place.left, place.top - lines * LEADING * SIZE, place.left + place.width, place.top)
    for one in layout.placements:
        if one.sheet == place.sheet:
            assert not move_shape(one.motion, one.piece.outline).intersects(box)
    frame = layout.settings.frame(layout.paper)
    assert frame.left <= place.left
    assert place.left + place.width <= frame.right + 1e-6
    sheets = draw_sheets(layout, notes=SHORT)
    assert len(sheets) == layout.sheet_count
    assert [HEADING in {text.text for text in written(sheet)} for sheet in sheets].count(True) == 1


def test_what_fits_nowhere_gets_a_sheet_of_its_own() -> None:
    layout = laid(0)
    assert notes_place(layout, LONG) is None
    assert draw_sheets(layout, notes=LONG)[-1].name == "Notes"
    assert len(draw_sheets(layout)) == layout.sheet_count

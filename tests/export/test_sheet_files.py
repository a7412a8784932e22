"""Files of single sheets are named after what is on them."""

from pathlib import Path

import pytest
from printed_design import Printed

from popsim.export import Printing, export
from popsim.layout import draw_sheets
from popsim.layout.sheet import Role, Text

LONG = tuple(f"flap {number} is in the way of M1.L by 2.1 mm at 40 degrees: trim it there" for number in range(45))
"""More than the last sheet has room for."""


@pytest.mark.parametrize("name", ["svg", "dxf"])
def test_sheets_are_numbered_as_their_titles_say(name: str, printed: Printed, tmp_path: Path) -> None:
    printing = Printing(two_sided=True, notes=LONG)
    made = export(printed.layout, tmp_path / f"s.{name}", name, texture_root=printed.folder, printing=printing)
    numbers = range(1, printed.layout.sheet_count + 1)
    sides = [f"s-{number}{side}.{name}" for number in numbers for side in ("", "-reverse")]
    assert [file.name for file in made] == [*sides, f"s-notes.{name}"]
    for number, file in zip(numbers, made[::2], strict=False):
        assert f"Sheet {number} of {len(numbers)}" in file.read_text()


def test_notes_of_their_own_have_nothing_to_cut(printed: Printed) -> None:
    *sheets, page = draw_sheets(printed.layout, notes=LONG, footer="popsim 0.1 sha256 abc")
    assert len(sheets) == printed.layout.sheet_count
    assert not page.of(Role.CUT, Role.MOUNTAIN, Role.VALLEY, Role.GLUE)
    words = [mark.text for mark in page.marks if isinstance(mark, Text)]
    assert "What to check" in words
    assert any("sha256 abc" in text for text in words)
    assert [text for text in words if "M1.L" in text][-1].startswith("45. ")


def test_notes_that_fit_need_no_page(printed: Printed) -> None:
    sheets = draw_sheets(printed.layout, notes=LONG[:1])
    assert [sheet.suffix for sheet in sheets] == [str(k) for k in range(1, printed.layout.sheet_count + 1)]


def test_every_page_says_how_it_is_made_again_and_can_be_measured(printed: Printed) -> None:
    pages = draw_sheets(printed.layout, two_sided=True, notes=LONG, footer="popsim 0.1 sha256 abc")
    for page in pages:
        words = " ".join(mark.text for mark in page.marks if isinstance(mark, Text))
        for wanted in ("sha256 abc", "5 cm", "2 in", "Print at 100 %"):
            assert wanted in words, page.name

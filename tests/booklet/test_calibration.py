"""The test build: it folds, it goes on one sheet, and the sheet says what to look at."""

import re

import pypdfium2
import pytest
from built_pop_up import Built

from popsim.layout import draw_sheets, lay_out
from popsim.layout.sheet import Text
from popsim.pipeline.calibration import CHECKS, calibration_design
from popsim.verification import verify


def test_it_has_a_box_and_a_wedge_and_folds() -> None:
    design = calibration_design()
    kinds = [mechanism.type for mechanism in design.mechanisms]
    assert kinds[0] == "box-fold"
    assert kinds[1].startswith("v-fold")
    assert verify(design).passed


@pytest.mark.parametrize("paper", ["A4", "Letter", "A5"])
def test_it_goes_on_one_sheet(paper: str) -> None:
    assert lay_out(calibration_design(), paper=paper).sheet_count == 1


def test_folder_holds_all_and_the_sheet_says_what_to_check(built: Built) -> None:
    names = {path.name for path in built.folder.iterdir()}
    assert {"sheets.pdf", "sheets-1.svg", "instructions.pdf", "instructions.html", "design.json"} <= names
    text = pypdfium2.PdfDocument(built.folder / "sheets.pdf")[0].get_textpage().get_text_range()
    assert "5 cm" in text
    for check in CHECKS:
        assert check in re.sub(r"\s+", " ", text)


def test_notes_get_a_sheet_of_their_own_where_there_is_no_room() -> None:
    sheets = draw_sheets(lay_out(calibration_design(), paper="A5"), notes=CHECKS)
    assert [sheet.name for sheet in sheets] == ["Sheet 1 of 1", "Notes"]
    written = {mark.text for mark in sheets[1].marks if isinstance(mark, Text)}
    assert any(text.startswith("5. Open it") for text in written)

"""The PDF as a printer sees it."""

from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from printed_design import Printed

from popsim.design import Card, Design
from popsim.export import Printing, export
from popsim.layout import draw_sheets, lay_out
from popsim.mechanisms import assemble

DPI = 600

FURNITURE = ("NOT VERIFIED", "sha256 abc", "5 cm", "2 in", "mountain", "cut")


@pytest.fixture(scope="module")
def pdf(printed: Printed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("pdf") / "s.pdf"
    (made,) = export(
        printed.layout,
        path,
        "pdf",
        texture_root=printed.folder,
        plan=printed.plan,
        printing=Printing(footer="popsim 0.1 seed 0 sha256 abc", banner="NOT VERIFIED"),
    )
    return made


def page_texts(path: Path) -> list[str]:
    document = pypdfium2.PdfDocument(path)
    return [page.get_textpage().get_text_bounded() for page in document]


def test_page_boxes_are_exact(pdf: Path) -> None:
    for page in pypdfium2.PdfDocument(pdf):
        assert page.get_size() == pytest.approx((210 * 72 / 25.4, 297 * 72 / 25.4), abs=1e-3)


def test_printers_are_told_not_to_scale(pdf: Path) -> None:
    assert b"/PrintScaling /None" in pdf.read_bytes()


def test_every_sheet_says_what_it_is(pdf: Path, printed: Printed) -> None:
    count = printed.layout.sheet_count
    for number, text in enumerate(page_texts(pdf)[:count], 1):
        for words in (
            f"Sheet {number} of {count}",
            "NOT VERIFIED",
            "sha256 abc",
            "5 cm",
            "2 in",
            "mountain",
            "cut",
        ):
            assert words in text


def test_a_verified_design_carries_no_banner(printed: Printed, tmp_path: Path) -> None:
    (made,) = export(printed.layout, tmp_path / "s.pdf", "pdf", texture_root=printed.folder)
    assert not any("VERIFIED" in text for text in page_texts(made))


def test_nothing_follows_the_sheets(pdf: Path, printed: Printed) -> None:
    assert len(page_texts(pdf)) == printed.layout.sheet_count


def test_sizes_are_true_at_600_dpi(tmp_path: Path) -> None:
    """A bare card of 120 x 60 mm on A5, measured on the rendered page."""
    design = assemble(Card(x=(-60, 60), depth=30), [])
    layout = lay_out(design, paper="A5")
    (made,) = export(layout, tmp_path / "s.pdf", "pdf", texture_root=tmp_path)
    bitmap = pypdfium2.PdfDocument(made)[0].render(scale=DPI / 72, grayscale=True).to_numpy().squeeze()
    dark = bitmap < 100
    low = layout.settings.corner(layout.paper)[1]
    high = dark[: int((210 - low + 1) / 25.4 * DPI)]  # above the legend
    rows, columns = (np.flatnonzero(high.mean(axis=axis) > 0.25) for axis in (1, 0))
    width, height = (
        (line[-1] - line[0] + 1) * 25.4 / DPI - 0.25 for line in (columns, rows)
    )  # less the line's width
    assert sorted((width, height)) == pytest.approx([60, 120], abs=0.1)


def test_pictures_lie_the_right_way_round(pdf: Path, printed: Printed) -> None:
    """The red corner of each picture is where the upper left corner of its patch went, so none is mirrored."""
    document = pypdfium2.PdfDocument(pdf)
    pages = [page.render(scale=4).to_numpy()[..., ::-1] for page in document]
    checked = 0
    for placement in printed.plan.layout.placements:
        for name, motion in placement.piece.motions.items():
            patch = printed.design.patch_by_id[name]
            if patch.texture_frame is None:
                continue
            frame = patch.texture_frame
            share = np.array([4 / 60, 1 - 4 / 40])  # middle of the red square
            spot = np.array(frame.origin) + share[0] * np.array(frame.right) + share[1] * np.array(frame.up)
            flat = printed.layout.parts[name].flat(spot)
            whole = placement.motion @ motion
            x, y = whole[:2, :2] @ flat + whole[:2, 2]
            if not _inside(printed.design, name, spot):
                continue
            pixels = pages[placement.sheet]
            row, column = int((297 - y) * 4 * 72 / 25.4), int(x * 4 * 72 / 25.4)
            red, green, blue = np.median(
                pixels[row - 2 : row + 3, column - 2 : column + 3].reshape(-1, 3), axis=0
            )[:3]
            assert red > 180, name
            assert max(green, blue) < 120, name
            checked += 1
    assert checked > 5


def _inside(design: Design, name: str, spot: np.ndarray) -> bool:
    from shapely.geometry import Point

    patch = design.patch_by_id[name]
    return bool(patch.plane.polygon(patch.points).buffer(-1.5).contains(Point(patch.plane.flat(spot))))


def test_sheets_are_the_same_for_the_plan_and_the_layout_but_for_numbers(printed: Printed) -> None:
    one, other = draw_sheets(printed.layout), draw_sheets(printed.plan.layout)
    assert [len(sheet.marks) for sheet in one] == [len(sheet.marks) for sheet in other]

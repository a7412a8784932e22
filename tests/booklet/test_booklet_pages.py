"""The booklet as PDF and HTML: complete, vector, self-contained, the same every time."""

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from built_pop_up import Built

from popsim.assembly import AssemblyPlan
from popsim.booklet import begun_booklet, begun_picture, write_booklet
from popsim.booklet.booklet import Booklet
from popsim.booklet.closing import HALF, closing
from popsim.booklet.eye import viewpoint
from popsim.booklet.format import NARROWEST, Format, booklet_format
from popsim.booklet.html import page_of
from popsim.booklet.inks import Ink
from popsim.booklet.legend import legend
from popsim.booklet.pages import draw_pages
from popsim.booklet.things import Eye, Kind
from popsim.layout import PAPERS, Paper, find_paper
from popsim.layout.sheet import Area, Line, Mark, Text
from popsim.pipeline.calibration import CHECKS, NAME
from popsim.simulation import Sweep

IMAGE = 3
"""Type of page objects that are pixels (FPDF_PAGEOBJ_IMAGE)."""


@pytest.fixture(scope="module")
def form(plan: AssemblyPlan) -> Format:
    return booklet_format(plan.layout.paper)


@pytest.fixture(scope="module")
def booklet(plan: AssemblyPlan, sweep: Sweep, form: Format) -> Booklet:
    return begun_booklet(plan, sweep, form, name="box")()


@pytest.fixture(scope="module")
def document(built: Built) -> pypdfium2.PdfDocument:
    return pypdfium2.PdfDocument(built.folder / "instructions.pdf")


def words(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def test_every_sentence_stands_in_the_pdf(document: pypdfium2.PdfDocument, built: Built) -> None:
    text = words(" ".join(page.get_textpage().get_text_range() for page in document))
    for step in built.plan.steps:
        assert words(step.text) in text
    for wanted in (NAME, "You need", "What the pictures say", "What to check", *CHECKS):
        assert wanted in text


def test_all_but_the_cover_is_vector(document: pypdfium2.PdfDocument) -> None:
    images = [sum(thing.type == IMAGE for thing in page.get_objects()) for page in document]
    assert images == [1] + [0] * (len(document) - 1)


def test_pages_are_half_a_sheet(document: pypdfium2.PdfDocument) -> None:
    for page in document:
        assert np.array(page.get_size()) * 25.4 / 72 == pytest.approx([148.5, 210.0])


def test_no_line_of_text_runs_out_of_its_column(document: pypdfium2.PdfDocument) -> None:
    margin = Format(Paper("any", 148.5, 210.0)).margin / 25.4 * 72
    for page in document:
        text = page.get_textpage()
        rights = [text.get_rect(k)[2] for k in range(text.count_rects())]
        assert max(rights) <= page.get_width() - margin


@pytest.mark.parametrize("name", PAPERS)
def test_pages_are_never_too_narrow_to_read(name: str) -> None:
    form = booklet_format(find_paper(name))
    assert NARROWEST <= form.page.width <= form.page.height or name in ("a5",)
    assert form.figure_height(20.0) >= form.height / 3


def test_small_paper_is_its_own_page() -> None:
    assert booklet_format(Paper("small", 190, 130)).page == Paper("small", 130, 190)


def corners(mark: Mark) -> np.ndarray:
    match mark:
        case Line():
            return mark.points
        case Area():
            return np.concatenate(mark.rings)
        case Text():
            return mark.at[None]
        case _:
            return np.concatenate(mark.clip)


def test_nothing_leaves_the_page_and_no_step_is_divided(booklet: Booklet, form: Format) -> None:
    pages = draw_pages(booklet, form)
    for page in pages:
        points = np.concatenate([corners(mark) for mark in page.marks])
        assert (points >= 0).all()
        assert (points <= [page.width, page.height]).all()
    home = {mark.text: k for k, page in enumerate(pages) for mark in page.of(Ink.NUMBER) if isinstance(mark, Text)}
    for entry in booklet.entries:
        page = pages[home[str(entry.number)]]
        panels = [mark for mark in entry.figure.marks if mark.role is Ink.PANEL]
        assert sum(mark.role is Ink.PANEL for mark in page.marks) >= len(panels)
        lines = [mark.text for mark in page.marks if isinstance(mark, Text)]
        assert entry.text.split(".")[0].split()[0] in " ".join(lines)


def test_nothing_is_written_over_the_foot_of_a_page(booklet: Booklet, form: Format) -> None:
    for page in draw_pages(booklet, form)[1:]:
        *text, foot = (mark for mark in page.marks if isinstance(mark, Text))
        assert foot.text == page.name and foot.at[1] < form.margin
        assert min(mark.at[1] for mark in text) > foot.at[1] + foot.size


def test_booklet_writes_each_number_and_each_new_piece(booklet: Booklet, plan: AssemblyPlan) -> None:
    for entry, step in zip(booklet.entries, plan.steps, strict=True):
        shown = {mark.text for mark in entry.figure.marks if isinstance(mark, Text)}
        fresh = [piece.name for piece in plan.layout.pieces if set(piece.motions) & set(step.parts)]
        for name in fresh:
            assert any(text.startswith(f"{name}, sheet") for text in shown)


def test_last_step_closes_the_card(plan: AssemblyPlan, sweep: Sweep) -> None:
    last = closing(plan.steps[-1], plan.layout, sweep)
    assert last.before is not None
    assert last.after is not None
    assert last.before.card_angle == pytest.approx(np.radians(HALF), abs=np.radians(1))
    assert last.after.card_angle == 0
    assert set(last.motion) == {"B"}
    eye = Eye(plan.layout, viewpoint())
    seen = {sight.thing.kind: 0.0 for sight in eye.look(last.after)}
    for sight in eye.look(last.after):
        seen[sight.thing.kind] += sight.seen.area.area
    assert seen[Kind.PAGE] > 20 * (seen[Kind.PART] + seen[Kind.FLAP])


def test_legend_explains_every_ink_of_the_figures(booklet: Booklet) -> None:
    told = {mark.role for sample, _ in legend() for mark in sample.marks}
    plain = {Ink.PANEL, Ink.RULE, Ink.CREASE, Ink.LEADER, Ink.TEXT, Ink.NOTE, Ink.BUBBLE}
    used = {mark.role for entry in booklet.entries for mark in entry.figure.marks}
    assert used <= told | plain


class Outline(HTMLParser):
    """Collects what a page refers to, its headings and its drawings."""

    def __init__(self) -> None:
        super().__init__()
        self.references: list[str] = []
        self.steps: list[str] = []
        self.drawings = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        self.references += [str(values[key]) for key in ("src", "href", "xlink:href", "data") if key in values]
        if tag == "h2" and str(values.get("id", "")).startswith("step-"):
            self.steps.append(str(values["id"]))
        self.drawings += tag == "svg"
        assert tag not in ("script", "link", "iframe")


def test_html_is_complete_and_needs_nothing_else(built: Built) -> None:
    text = (built.folder / "instructions.html").read_text()
    outline = Outline()
    outline.feed(text)
    assert outline.steps == [f"step-{step.number}" for step in built.plan.steps]
    assert outline.drawings == len(built.plan.steps) + len(legend())
    assert all(reference.startswith(("data:", "#")) for reference in outline.references)
    assert "url(" not in text.replace("url(#", "")
    ids = re.findall(r'\bid="([^"]+)"', text)
    assert len(ids) == len(set(ids))


def test_same_plan_gives_the_same_bytes(built: Built, sweep: Sweep, tmp_path: Path) -> None:
    form = booklet_format(built.plan.layout.paper)
    booklet = begun_booklet(built.plan, sweep, form, name=NAME, checks=CHECKS)
    files = write_booklet(booklet, begun_picture(built.design, tmp_path), form, tmp_path)
    for file in files:
        assert file.read_bytes() == (built.folder / file.name).read_bytes(), file.name


def test_warning_stands_on_the_cover(booklet: Booklet, form: Format, built: Built) -> None:
    warned = replace(booklet, name="<box>", banner="NOT VERIFIED")
    assert "NOT VERIFIED" in [mark.text for mark in draw_pages(warned, form)[0].marks if isinstance(mark, Text)]
    assert "<strong>NOT VERIFIED</strong>" in page_of(warned, built.folder)
    assert "<box>" not in page_of(warned, built.folder)
    assert "<strong>" not in page_of(booklet, built.folder)


def test_what_to_check_stands_where_there_is_room(booklet: Booklet, form: Format) -> None:
    """One sentence never takes a page of its own while the cover has room; many do."""
    without = len(draw_pages(replace(booklet, checks=()), form))
    assert len(draw_pages(replace(booklet, checks=CHECKS[:1]), form)) == without
    assert len(draw_pages(replace(booklet, checks=CHECKS * 4), form)) == without + 1


def test_something_stands_out_in_every_step_that_glues(booklet: Booklet, built: Built) -> None:
    glues = {step.number for step in built.plan.steps if step.flaps}
    for entry in booklet.entries:
        if entry.number in glues:
            assert {Ink.NEW, Ink.NEW_REVERSE} & {mark.role for mark in entry.figure.marks}

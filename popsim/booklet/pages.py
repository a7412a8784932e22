"""The booklet as pages: cover, tools and legend, steps two to a page, what to check where there is room."""

from collections.abc import Iterator

import numpy as np

from popsim import wording
from popsim.booklet.booklet import PICTURE, SIZE, Booklet, Entry
from popsim.booklet.column import Column, text_height
from popsim.booklet.format import GAP, Format
from popsim.booklet.inks import Ink
from popsim.booklet.legend import legend
from popsim.layout.sheet import Mark, Picture, Sheet, Text

TITLE, NAME, HEADING, NUMBER = 9.0, 5.0, 5.0, 9.0
"""mm; font sizes."""


def draw_pages(booklet: Booklet, form: Format) -> tuple[Sheet, ...]:
    """All pages; a step is never divided between two."""
    columns = [_cover(booklet, form), _reading(form), *_steps(booklet.entries, form)]
    if booklet.checks:
        _check(columns, booklet.checks, form)
    return tuple(_page(column, k, len(columns), form) for k, column in enumerate(columns, 1))


def _page(column: Column, number: int, count: int, form: Format) -> Sheet:
    name = wording.PAGE.format(page=number, pages=count)
    marks: list[Mark] = list(column.marks)
    if number > 1:
        foot = np.array([form.page.width / 2, form.margin - 3.0])
        marks.append(Text(Ink.NOTE, name, foot, 2.4, anchor="middle"))
    return Sheet(name, form.page.width, form.page.height, tuple(marks))


def _column(form: Format) -> Column:
    return Column(form.margin, form.width, form.page.height - form.margin)


def _cover(booklet: Booklet, form: Format) -> Column:
    column = _column(form)
    column.skip(6.0)
    column.paragraph(wording.TITLE, TITLE, bold=True)
    column.skip(2.0)
    column.paragraph(booklet.name, NAME, Ink.NOTE)
    column.skip(8.0)
    height = form.width / (SIZE[0] / SIZE[1])
    column.skip(height)
    frame = np.array([[form.width, 0, column.left], [0, height, column.top], [0, 0, 1.0]])
    corners = np.array([[0, 0], [form.width, 0], [form.width, height], [0, height]])
    column.marks.append(Picture(Ink.PICTURE, PICTURE, frame, (corners + np.array([column.left, column.top]),)))
    column.skip(8.0)
    column.paragraph(booklet.facts, form.body)
    if booklet.banner is not None:
        column.skip(4.0)
        column.paragraph(booklet.banner, NAME, bold=True)
    return column


def _reading(form: Format) -> Column:
    column = _listed(form, wording.NEEDED, wording.TOOLS)
    column.skip(2.5)
    column.paragraph(wording.LEGEND, HEADING, bold=True)
    column.skip(1.5)
    for sample, meaning in legend():
        words = column.indented(sample.width + 4.0)
        height = text_height(meaning, form.body, words.width)
        row = max(sample.height, height) + 0.4
        words.skip((row - height) / 2)
        words.paragraph(meaning, form.body)
        end = column.top - row
        column.skip((row - sample.height) / 2)
        column.drawing(sample)
        column.top = end
    column.skip(2.5)
    _list(column, form, wording.ADVICE, wording.TIPS)
    return column


def _check(columns: list[Column], checks: tuple[str, ...], form: Format) -> None:
    """Write what to check below the last step where there is room, else on the cover or on a page of its own."""
    trial = _listed(form, wording.CHECKS, checks)
    foot = form.page.height - form.margin - form.height
    height = form.page.height - form.margin - trial.top + 2 * GAP
    roomy = next((column for column in (columns[-1], columns[0]) if column.top - height > foot), None)
    if roomy is None:
        columns.append(trial)
    else:
        roomy.skip(2 * GAP)
        _list(roomy, form, wording.CHECKS, checks)


def _listed(form: Format, heading: str, items: tuple[str, ...]) -> Column:
    column = _column(form)
    _list(column, form, heading, items)
    return column


def _list(column: Column, form: Format, heading: str, items: tuple[str, ...]) -> None:
    column.paragraph(heading, HEADING, bold=True)
    column.skip(1.5)
    for item in items:
        words = column.indented(4.0)
        column.marks.append(
            Text(Ink.NUMBER, "•", np.array([column.left, column.top - 1.1 * form.body]), form.body)
        )
        words.paragraph(item, form.body)
        column.top = words.top - 0.8


def _steps(entries: tuple[Entry, ...], form: Format) -> Iterator[Column]:
    column: Column | None = None
    for entry in entries:
        height = _height(entry, form)
        if column is None or column.top - height < form.page.height - form.margin - form.height - 0.01:
            if column is not None:
                yield column
            column = _column(form)
        _entry(column, entry, form)
        column.skip(2 * GAP)
    if column is not None:
        yield column


def _height(entry: Entry, form: Format) -> float:
    return _head(entry, form) + GAP + entry.figure.height


def _head(entry: Entry, form: Format) -> float:
    return max(text_height(entry.text, form.body, form.text_width), 0.8 * form.indent)


def _entry(column: Column, entry: Entry, form: Format) -> None:
    top = column.top
    number = np.array([column.left, top - 0.8 * NUMBER])
    column.marks.append(Text(Ink.NUMBER, str(entry.number), number, NUMBER, bold=True))
    column.indented(form.indent).paragraph(entry.text, form.body)
    column.top = top - _head(entry, form) - GAP
    column.drawing(entry.figure)

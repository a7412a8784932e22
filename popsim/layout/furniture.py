"""What stands round the pieces on every sheet: title, banner, legend, scale bars, reproduction line."""

from collections.abc import Iterator
from textwrap import wrap

import numpy as np

from popsim.layout.paper import Paper
from popsim.layout.registration import REGISTRATIONS
from popsim.layout.settings import HEADER, LayoutSettings
from popsim.layout.sheet import TEXT_WIDTH, Area, Line, Mark, Role, Text

SMALL = 2.2
"""mm; font size of the legend."""

FINE = 1.8
"""mm; font size of the reproduction line."""

INCH = 25.4

LEGEND = (
    (Role.CUT, "cut"),
    (Role.MOUNTAIN, "mountain fold: away from you"),
    (Role.VALLEY, "valley fold: towards you"),
)


def furnish(
    paper: Paper, settings: LayoutSettings, title: str, *, footer: str, banner: str | None
) -> Iterator[Mark]:
    """Marks in the bands above and below the pieces."""
    left, right = settings.border, paper.width - settings.border
    yield from _head(paper, settings, title, banner)
    base = settings.border
    yield from _footer(footer, left, right, base)
    yield from _scale_bars(left, base + 6.5)
    yield from _legend(left, base + 13.5)
    yield from REGISTRATIONS[settings.registration].marks(paper)


def _head(paper: Paper, settings: LayoutSettings, title: str, banner: str | None) -> Iterator[Mark]:
    y = paper.height - settings.border - HEADER + 2
    yield Text(Role.LABEL, title, np.array([paper.width - settings.border, y]), 3.0, anchor="end")
    if banner:
        room = paper.width - 2 * settings.border - 30
        size = min(4.0, room / max(len(banner), 1) / (TEXT_WIDTH * 1.1))
        yield Text(Role.LABEL, banner, np.array([settings.border, y]), size, bold=True)


def _footer(footer: str, left: float, right: float, base: float) -> Iterator[Text]:
    letters = int((right - left) / (TEXT_WIDTH * FINE))
    lines = wrap(footer, letters)[:2]
    for k, line in enumerate(reversed(lines)):
        yield Text(Role.LABEL, line, np.array([left, base + 0.5 + 2.4 * k]), FINE)


def _scale_bars(left: float, y: float) -> Iterator[Mark]:
    yield from _bar(left, y, 10.0, 5, "5 cm")
    yield from _bar(left + 64, y, INCH, 2, "2 in")
    note = "Print at 100 % and measure the bars."
    yield Text(Role.LABEL, note, np.array([left + 130, y]), SMALL)


def _bar(left: float, y: float, step: float, count: int, name: str) -> Iterator[Mark]:
    def line(x0: float, y0: float, x1: float, y1: float) -> Line:
        return Line(Role.LABEL, np.array([[x0, y0], [x1, y1]]))

    yield line(left, y, left + step * count, y)
    for k in range(count + 1):
        yield line(left + step * k, y, left + step * k, y + (2.5 if k in (0, count) else 1.5))
    yield Text(Role.LABEL, name, np.array([left + step * count + 1.5, y]), SMALL)


def _legend(left: float, y: float) -> Iterator[Mark]:
    middle = y + 0.35 * SMALL
    x = left
    for role, name in LEGEND:
        yield Line(Role.LABEL, np.array([[x, middle], [x + 11, middle]]), looks=role)
        yield Text(Role.LABEL, name, np.array([x + 12.5, y]), SMALL)
        x += 12.5 + TEXT_WIDTH * SMALL * len(name) + 2
    square = np.array([[x, y - 0.3], [x + 5, y - 0.3], [x + 5, y + 2], [x, y + 2]])
    yield Area(Role.LABEL, (square,), looks=Role.GLUE)
    yield Text(Role.LABEL, "7: flap 7 goes here; (7): behind here", np.array([x + 6, y]), SMALL)

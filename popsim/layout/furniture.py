"""What stands round the pieces on every sheet: title, banner, legend, scale bars, reproduction line."""

from collections.abc import Iterator

import numpy as np

from popsim.layout.paper import Paper
from popsim.layout.registration import REGISTRATIONS
from popsim.layout.settings import HEADER, LayoutSettings
from popsim.layout.sheet import TEXT_WIDTH, Area, Line, Mark, Role, Text, text_width, wrapped
from popsim.stock import CreaseAdvice

SMALL = 2.2
"""mm; font size of the legend."""

TITLE = 2.6
"""mm; font size of the title."""

FINE = 1.8
"""mm; font size of the reproduction line."""

INCH = 25.4

LEGEND = (
    (Role.CUT, "cut"),
    (Role.MOUNTAIN, "mountain fold: away from you"),
    (Role.VALLEY, "valley fold: towards you"),
)

PLACES = "7: flap 7 goes here; (7): behind here"

ADVICE: dict[CreaseAdvice, str] = {
    "fold": "fold without scoring",
    "score": "score each crease before you fold it",
    "perforate": "cut through the dashes of each crease",
}

SAMPLE = 11.5
"""mm; what a sample in the legend takes."""


def furnish(
    paper: Paper, settings: LayoutSettings, title: str, *, footer: str, banner: str | None
) -> Iterator[Mark]:
    """Marks in the bands above and below the pieces."""
    left, right = settings.border, paper.width - settings.border
    yield from _head(paper, settings, title, banner)
    base = settings.border
    yield from _footer(footer, left, right, base)
    yield from _scale_bars(left, base + 5.2)
    yield from _legend(left, right, base + 9.7)
    yield from REGISTRATIONS[settings.registration].marks(paper)


def _head(paper: Paper, settings: LayoutSettings, title: str, banner: str | None) -> Iterator[Mark]:
    y = paper.height - settings.border - HEADER + 1.4
    if settings.stock is not None:
        title = f"{settings.stock.name}: {ADVICE[settings.stock.crease_advice]}.  {title}"
    yield Text(Role.LABEL, title, np.array([paper.width - settings.border, y]), TITLE, anchor="end")
    if banner:
        room = paper.width - 2 * settings.border - text_width(title, TITLE) - 5
        size = min(HEADER - 1, room / max(len(banner), 1) / (TEXT_WIDTH * 1.1))
        yield Text(Role.LABEL, banner, np.array([settings.border, y]), size, bold=True)


def _footer(footer: str, left: float, right: float, base: float) -> Iterator[Text]:
    lines = wrapped(footer, FINE, right - left)[:2]
    for k, line in enumerate(reversed(lines)):
        yield Text(Role.LABEL, line, np.array([left, base + 0.5 + 2.2 * k]), FINE)


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


def _legend(left: float, right: float, y: float) -> Iterator[Mark]:
    """Samples with their meanings, side by side; smaller on narrow paper."""
    words = [name for _, name in LEGEND] + [PLACES]
    natural = sum(SAMPLE + TEXT_WIDTH * SMALL * len(name) + 2 for name in words)
    scale = min(1.0, (right - left) / natural)
    x = left
    for role, name in (*LEGEND, (None, PLACES)):
        if role is None:
            low, high = [x, y - 0.3 * scale], [x + 10 * scale, y + 2 * scale]
            square = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
            yield Area(Role.LABEL, (square,), looks=Role.GLUE)
        else:
            middle = y + 0.35 * SMALL * scale
            yield Line(Role.LABEL, np.array([[x, middle], [x + 10 * scale, middle]]), looks=role)
        yield Text(Role.LABEL, name, np.array([x + SAMPLE * scale, y]), SMALL * scale)
        x += (SAMPLE + TEXT_WIDTH * SMALL * len(name) + 2) * scale

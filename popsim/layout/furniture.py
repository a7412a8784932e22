"""What stands round the pieces on every sheet: title, banner, legend, scale bars, reproduction line."""

from collections.abc import Iterator, Sequence

import numpy as np

from popsim.layout.paper import Paper
from popsim.layout.registration import REGISTRATIONS
from popsim.layout.settings import HEADER, Frame, LayoutSettings
from popsim.layout.sheet import TEXT_WIDTH, Area, Line, Mark, Role, Text, text_width, wrapped
from popsim.stock import CreaseAdvice, Stock

SMALL = 2.2
"""mm; font size of the legend."""

TITLE = 2.6
"""mm; font size of the title."""

HEADING = 3.0
"""mm; font size of the heading of a reverse."""

FINE = 1.8
"""mm; font size of the reproduction line."""

INCH = 25.4

LEGEND = (
    (Role.CUT, "cut"),
    (Role.MOUNTAIN, "mountain fold: away from you"),
    (Role.VALLEY, "valley fold: towards you"),
)

PLACE, BEHIND = "7: flap 7 goes here", "(7): behind here"

ADVICE: dict[CreaseAdvice, str] = {
    "fold": "fold without scoring",
    "score": "score each crease before you fold it",
    "perforate": "cut through the dashes of each crease",
}

NOTE = "Print at 100 % and measure the bars."

BARS = 130.0
"""mm; what the scale bars take."""

SAMPLE = 11.5
"""mm; what a sample in the legend takes."""


def furnish(
    paper: Paper,
    settings: LayoutSettings,
    title: str,
    *,
    footer: str,
    banner: str | None,
    two_sided: bool = False,
) -> Iterator[Mark]:
    """Marks in the bands above and below the pieces; with `two_sided`, what is glued behind is drawn there."""
    frame = settings.frame(paper)
    yield from _head(frame, settings.stock, title, banner)
    yield from _measures(frame, footer)
    yield from _legend(frame, LEGEND, PLACE if two_sided else f"{PLACE}; {BEHIND}")
    yield from REGISTRATIONS[settings.registration].marks(paper)


def furnish_reverse(
    paper: Paper, settings: LayoutSettings, title: str, *, footer: str, banner: str | None
) -> Iterator[Mark]:
    """The same of the back of a sheet, on which there are places and names alone."""
    frame = settings.frame(paper)
    words = f"{title}: print on the back, flipped on the long edge. {banner or ''}".rstrip()
    yield Text(Role.LABEL, words, np.array([frame.left, frame.high - HEADING]), HEADING)
    yield from _measures(frame, footer)
    yield from _legend(frame, (), f"{PLACE}, on this side")


def _measures(frame: Frame, footer: str) -> Iterator[Mark]:
    """The scale bars, what to do with them, and the line that reproduces the sheet, at its foot."""
    beside = frame.width >= BARS + text_width(NOTE, SMALL)
    yield from _footer(footer if beside else f"{NOTE} {footer}", frame)
    yield from _scale_bars(frame.left, frame.low + 5.2)
    if beside:
        yield Text(Role.LABEL, NOTE, np.array([frame.left + BARS, frame.low + 5.2]), SMALL)


def _head(frame: Frame, stock: Stock | None, title: str, banner: str | None) -> Iterator[Mark]:
    y = frame.high - HEADER + 1.4
    if stock is not None:
        title = f"{stock.name}: {ADVICE[stock.crease_advice]}.  {title}"
    yield Text(Role.LABEL, title, np.array([frame.right, y]), TITLE, anchor="end")
    if banner:
        room = frame.width - text_width(title, TITLE) - 5
        size = min(HEADER - 1, room / max(len(banner), 1) / (TEXT_WIDTH * 1.1))
        yield Text(Role.LABEL, banner, np.array([frame.left, y]), size, bold=True)


def _footer(footer: str, frame: Frame) -> Iterator[Text]:
    lines = wrapped(footer, FINE, frame.width)[:2]
    for k, line in enumerate(reversed(lines)):
        yield Text(Role.LABEL, line, np.array([frame.left, frame.low + 0.5 + 2.2 * k]), FINE)


def _scale_bars(left: float, y: float) -> Iterator[Mark]:
    yield from _bar(left, y, 10.0, 5, "5 cm")
    yield from _bar(left + 64, y, INCH, 2, "2 in")


def _bar(left: float, y: float, step: float, count: int, name: str) -> Iterator[Mark]:
    def line(x0: float, y0: float, x1: float, y1: float) -> Line:
        return Line(Role.LABEL, np.array([[x0, y0], [x1, y1]]))

    yield line(left, y, left + step * count, y)
    for k in range(count + 1):
        yield line(left + step * k, y, left + step * k, y + (2.5 if k in (0, count) else 1.5))
    yield Text(Role.LABEL, name, np.array([left + step * count + 1.5, y]), SMALL)


def _legend(frame: Frame, lines: Sequence[tuple[Role, str]], place: str) -> Iterator[Mark]:
    """Samples of lines and of a place with their meanings, side by side; smaller on narrow paper."""
    words = [name for _, name in lines] + [place]
    natural = sum(SAMPLE + TEXT_WIDTH * SMALL * len(name) + 2 for name in words)
    scale = min(1.0, frame.width / natural)
    x, y = frame.left, frame.low + 9.7
    for role, name in (*lines, (None, place)):
        if role is None:
            low, high = [x, y - 0.3 * scale], [x + 10 * scale, y + 2 * scale]
            square = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
            yield Area(Role.LABEL, (square,), looks=Role.GLUE)
        else:
            middle = y + 0.35 * SMALL * scale
            yield Line(Role.LABEL, np.array([[x, middle], [x + 10 * scale, middle]]), looks=role)
        yield Text(Role.LABEL, name, np.array([x + SAMPLE * scale, y]), SMALL * scale)
        x += (SAMPLE + TEXT_WIDTH * SMALL * len(name) + 2) * scale

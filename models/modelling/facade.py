"""Painted windows, doors, stones and tiles."""

from collections.abc import Iterable

import numpy as np

from modelling.brush import Brush, Colour

Span = tuple[float, float]
Look = tuple[Colour, Colour]  # of the frame and the glass of a window


def window(brush: Brush, centre: Span, size: Span, colours: Look, *, arched: bool = False) -> None:
    """Paint a window with cross bars and a sill; `arched` rounds its top."""
    (a, b), (width, height), (frame, glass) = centre, size, colours
    rim = width * 0.14
    for grow, colour in ((rim, frame), (0.0, glass)):
        half, top = width / 2 + grow, b + height / 2
        brush.rect((a - half, a + half), (b - height / 2 - grow, top + (0 if arched else grow)), colour)
        if arched:
            brush.disc((a, top), half, colour)
    bar = width * 0.05
    brush.rect((a - bar, a + bar), (b - height / 2, b + height / 2 + (width / 2 if arched else 0)), frame)
    brush.rect((a - width / 2, a + width / 2), (b - bar, b + bar), frame)
    brush.rect(
        (a - width * 0.72, a + width * 0.72), (b - height / 2 - rim * 1.6, b - height / 2 - rim * 0.6), frame
    )


def windows(
    brush: Brush,
    columns: Iterable[float],
    rows: Iterable[float],
    size: Span,
    colours: Look,
    *,
    arched: bool = False,
) -> None:
    """Paint a window at every crossing of columns and rows."""
    heights = list(rows)
    for a in columns:
        for b in heights:
            window(brush, (a, b), size, colours, arched=arched)


def courses(brush: Brush, across: Span, upward: Span, size: Span, joint: Colour, *, width: float = 0.008) -> None:
    """Paint the joints of a bond of stones or tiles of a size."""
    count = round((upward[1] - upward[0]) / size[1])
    for i in range(count):
        b = upward[0] + i * size[1]
        brush.rect(across, (b - width / 2, b + width / 2), joint)
        for a in np.arange(across[0] + size[0] * (0.5 if i % 2 else 1.0), across[1], size[0]):
            brush.rect((a - width / 2, a + width / 2), (b, min(b + size[1], upward[1])), joint)


def quoins(brush: Brush, across: Span, upward: Span, size: Span, fill: Colour) -> None:
    """Paint corner stones, long and short in turn, at both ends of a wall."""
    for i in range(round((upward[1] - upward[0]) / size[1])):
        b, length = upward[0] + i * size[1], size[0] * (1.0 if i % 2 else 0.65)
        for start, sign in ((across[0], 1), (across[1], -1)):
            brush.rect((start, start + sign * length), (b + 0.01, b + size[1] - 0.01), fill)


def clock(brush: Brush, centre: Span, radius: float) -> None:
    """Paint a clock that shows ten past ten."""
    a, b = centre
    for share, colour in ((1.0, "#3b3f46"), (0.9, "#c9a14a"), (0.82, "#fbf7ea")):
        brush.disc(centre, radius * share, colour)
    for hour in range(12):
        angle = hour * np.pi / 6
        ray = np.array([np.sin(angle), np.cos(angle)])
        inner, outer = (np.array(centre) + radius * share * ray for share in (0.62, 0.75))
        brush.line([tuple(inner.tolist()), tuple(outer.tolist())], "#3b3f46", radius * 0.07)
    for angle, length in ((-np.pi / 3, 0.42), (np.pi / 3, 0.62)):
        tip = (a + radius * length * float(np.sin(angle)), b + radius * length * float(np.cos(angle)))
        brush.line([centre, tip], "#1f2227", radius * 0.08)
    brush.disc(centre, radius * 0.08, "#1f2227")

"""Notes to read on the paper itself: above the pieces where there is room, else on a sheet of their own."""

from collections.abc import Iterator

import numpy as np

from popsim.geometry.flat import move_shape
from popsim.layout.layout import Layout
from popsim.layout.settings import HEADER
from popsim.layout.sheet import Mark, Role, Text, wrapped

HEADING = "What to check"

SIZE, LEADING = 3.0, 1.45
"""mm, the font size of notes, and their line pitch in font sizes."""


def note_marks(layout: Layout, notes: tuple[str, ...]) -> Iterator[Mark]:
    """Marks of the notes under their heading, at the top of a sheet."""
    left, top = layout.settings.frame(layout.paper).left, _top(layout)
    yield Text(Role.LABEL, HEADING, np.array([left, top - SIZE]), 1.3 * SIZE, bold=True)
    for k, line in enumerate(_lines(layout, notes), 2):
        yield Text(Role.LABEL, line, np.array([left, top - k * LEADING * SIZE]), SIZE)


def notes_fit(layout: Layout, notes: tuple[str, ...]) -> bool:
    """Whether there is room for the notes above the pieces of the last sheet."""
    height = (len(_lines(layout, notes)) + 2) * LEADING * SIZE
    return _top(layout) - height > _highest(layout, layout.sheet_count - 1)


def _top(layout: Layout) -> float:
    return layout.settings.frame(layout.paper).high - HEADER - SIZE


def _lines(layout: Layout, notes: tuple[str, ...]) -> list[str]:
    room = layout.settings.frame(layout.paper).width
    return [line for k, note in enumerate(notes, 1) for line in wrapped(f"{k}. {note}", SIZE, room)]


def _highest(layout: Layout, sheet: int) -> float:
    """Upper end of the pieces on a sheet, mm from the lower edge of the paper."""
    own = [placement for placement in layout.placements if placement.sheet == sheet]
    return max(float(move_shape(one.motion, one.piece.outline).bounds[3]) for one in own)

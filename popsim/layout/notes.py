"""Notes to read on the paper itself: beside the pieces wherever there is room, else on a sheet of their own."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.geometry.flat import move_shape
from popsim.layout.layout import Layout
from popsim.layout.settings import FOOTER, HEADER
from popsim.layout.sheet import Mark, Role, Text, wrapped

HEADING = "What to check"

SIZE, LEADING = 3.0, 1.45
"""mm, the font size of notes, and their line pitch in font sizes."""

COLUMNS = (1, 2, 3, 4)
"""Into how many columns a sheet is divided to look for room for one of notes; the widest that fits is taken."""

STEP, CLEAR = 4.0, 2.0
"""mm between places that are tried, and between notes and pieces."""


@dataclass(frozen=True)
class NotesPlace:
    """Where notes stand: a sheet, from 0, and there the upper left corner and the width of a column, mm."""

    sheet: int
    left: float
    top: float
    width: float


def notes_place(layout: Layout, notes: tuple[str, ...]) -> NotesPlace | None:
    """The place with room for notes: on the last sheet that has any, as wide and high up as can be; or None."""
    for sheet in reversed(range(layout.sheet_count)):
        for count in COLUMNS:
            found = _room(layout, sheet, layout.settings.frame(layout.paper).width / count, notes)
            if found is not None:
                return found
    return None


def own_sheet(layout: Layout) -> NotesPlace:
    """The place on a sheet that has nothing else."""
    frame = layout.settings.frame(layout.paper)
    return NotesPlace(layout.sheet_count, frame.left, _top(layout), frame.width)


def note_marks(notes: tuple[str, ...], place: NotesPlace) -> Iterator[Mark]:
    """Marks of the notes under their heading."""
    yield Text(Role.LABEL, HEADING, np.array([place.left, place.top - SIZE]), 1.3 * SIZE, bold=True)
    for k, line in enumerate(_lines(notes, place.width), 2):
        yield Text(Role.LABEL, line, np.array([place.left, place.top - k * LEADING * SIZE]), SIZE)


def _room(layout: Layout, sheet: int, width: float, notes: tuple[str, ...]) -> NotesPlace | None:
    """The highest place on a sheet for a column of some width, the leftmost of these."""
    import shapely

    frame = layout.settings.frame(layout.paper)
    height = (len(_lines(notes, width)) + 1.5) * LEADING * SIZE
    lowest = frame.low + FOOTER + height
    lefts = np.arange(frame.left, frame.right - width + 1e-6, STEP)
    tops = np.arange(_top(layout), lowest - 1e-6, -STEP)
    if not len(tops):
        return None
    x, y = (grid.ravel() for grid in np.meshgrid(lefts, tops))
    own = [move_shape(one.motion, one.piece.outline) for one in layout.placements if one.sheet == sheet]
    taken = shapely.union_all(own).buffer(CLEAR)
    shapely.prepare(taken)
    free = np.flatnonzero(~shapely.intersects(taken, shapely.box(x, y - height, x + width, y)))
    return NotesPlace(sheet, float(x[free[0]]), float(y[free[0]]), width) if len(free) else None


def _top(layout: Layout) -> float:
    return layout.settings.frame(layout.paper).high - HEADER - SIZE


def _lines(notes: tuple[str, ...], width: float) -> list[str]:
    return [line for k, note in enumerate(notes, 1) for line in wrapped(f"{k}. {note}", SIZE, width)]

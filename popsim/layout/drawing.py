"""Drawing a layout: the marks of all pieces on their sheets, and the furniture round them."""

from popsim.layout.furniture import furnish, furnish_reverse
from popsim.layout.layout import Layout
from popsim.layout.notes import note_marks, notes_place, own_sheet
from popsim.layout.piece_marks import piece_marks, reverse_marks
from popsim.layout.sheet import Mark, Meaning, Role, Sheet


def draw_sheets(
    layout: Layout,
    *,
    footer: str = "",
    banner: str | None = None,
    two_sided: bool = False,
    notes: tuple[str, ...] = (),
) -> tuple[Sheet, ...]:
    """Draw all sheets of a layout.

    Parameters
    ----------
    footer:
        What reproduces the sheets; printed on each.
    banner:
        A warning on each sheet, or None.
    two_sided:
        Follow each sheet by its reverse, mirrored, to be printed on the back of it (flipped on the long edge): the
        places that are glued there stand on it instead of numbers in brackets on the front.
    notes:
        What to check: on the last sheet that has room for it, else on a page of their own, whose name says that
        there is nothing to cut.
    """
    sheets = []
    place = notes_place(layout, notes) if notes else None
    for number in range(layout.sheet_count):
        own = [placement for placement in layout.placements if placement.sheet == number]
        title = f"Sheet {number + 1} of {layout.sheet_count}"
        marks = [mark for placement in own for mark in piece_marks(layout, placement, two_sided=two_sided)]
        if place is not None and place.sheet == number:
            marks += note_marks(notes, place)
        marks += furnish(layout.paper, layout.settings, title, footer=footer, banner=banner, two_sided=two_sided)
        sheets.append(_sheet(layout, title, marks, f"{number + 1}"))
        if two_sided:
            width = layout.paper.width
            behind = [mark for placement in own for mark in reverse_marks(layout, placement, width)]
            title = f"{title}, reverse"
            behind += furnish_reverse(layout.paper, layout.settings, title, footer=footer, banner=banner)
            sheets.append(_sheet(layout, title, behind, f"{number + 1}-reverse"))
    if notes and place is None:
        furniture = furnish(layout.paper, layout.settings, "Notes", footer=footer, banner=banner)
        sheets.append(_sheet(layout, "Notes", [*note_marks(notes, own_sheet(layout)), *furniture], "notes"))
    return tuple(sheets)


def _sheet(layout: Layout, title: str, marks: list[Mark], suffix: str) -> Sheet:
    """Marks in the order of their roles: pictures at the bottom, texts near the top."""
    order: list[Meaning] = list(Role)
    marks.sort(key=lambda mark: order.index(mark.role))
    return Sheet(title, layout.paper.width, layout.paper.height, tuple(marks), suffix)

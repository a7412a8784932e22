"""A column of text and drawings on a page, written from top to bottom."""

from dataclasses import dataclass, field

import numpy as np

from popsim.booklet.inks import Ink
from popsim.layout.sheet import Mark, Sheet, Text, shifted, wrapped

LEADING = 1.4
"""Line pitch in font sizes."""

LETTER = 0.54
"""Width of a letter of a sentence in font sizes; the mean of steps' sentences is 0.51."""


def text_height(text: str, size: float, width: float) -> float:
    """Height of a paragraph, mm."""
    return len(wrapped(text, size, width, letter=LETTER)) * LEADING * size


@dataclass
class Column:
    """Marks so far, and where the next begin.

    Attributes
    ----------
    left, width:
        Of the column on its page, mm.
    top:
        Where the next mark hangs from, mm from the lower edge of the page.
    """

    left: float
    width: float
    top: float
    marks: list[Mark] = field(default_factory=list)

    def paragraph(self, text: str, size: float, ink: Ink = Ink.TEXT, *, bold: bool = False) -> None:
        """Write a text below what is there."""
        for line in wrapped(text, size, self.width, letter=LETTER):
            self.top -= LEADING * size
            base = np.array([self.left, self.top + 0.3 * size])
            self.marks.append(Text(ink, line, base, size, bold=bold))

    def drawing(self, sheet: Sheet) -> None:
        """Put a drawing below what is there."""
        self.top -= sheet.height
        self.marks += [shifted(mark, np.array([self.left, self.top])) for mark in sheet.marks]

    def skip(self, height: float) -> None:
        """Leave some room, mm."""
        self.top -= height

    def indented(self, indent: float) -> "Column":
        """A narrower column that begins at the same height and writes to the same page."""
        return Column(self.left + indent, self.width - indent, self.top, self.marks)

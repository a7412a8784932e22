"""The size of a booklet's pages, and what goes on one."""

from dataclasses import dataclass

from popsim.layout import Paper

NARROWEST = 125.0
"""mm; narrower pages would not be readable."""

GAP = 3.0
"""mm between the text of a step and its figure."""


@dataclass(frozen=True)
class Format:
    """Pages of a booklet, mm.

    Attributes
    ----------
    page:
        Its paper.
    margin:
        White round every page.
    body:
        Font size of the text.
    indent:
        Room for the number before the text of a step.
    """

    page: Paper
    margin: float = 9.0
    body: float = 3.3
    indent: float = 15.0

    @property
    def width(self) -> float:
        """Of what is printed."""
        return self.page.width - 2 * self.margin

    @property
    def height(self) -> float:
        """Of what is printed, without the page number."""
        return self.page.height - 2 * self.margin - 4.0

    @property
    def text_width(self) -> float:
        """Of the text of a step."""
        return self.width - self.indent

    @property
    def block(self) -> float:
        """Height of a step: two go on a page."""
        return self.height / 2 - GAP

    def figure_height(self, text: float, *, whole_page: bool = False) -> float:
        """Height of the figure below a text that is `text` mm high; at least a third of the page."""
        room = self.height if whole_page else self.block
        return max(room - max(text, 0.8 * self.indent) - GAP, self.height / 3)


def booklet_format(sheet: Paper) -> Format:
    """Half the user's sheet, so that two pages go on one; the sheet itself where that would be too small."""
    low, high = sorted((sheet.width, sheet.height))
    if high / 2 >= NARROWEST:
        return Format(Paper(f"half {sheet.name}", high / 2, low))
    return Format(Paper(sheet.name, low, high))

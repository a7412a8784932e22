"""Paper formats by name. A new one is one row of the table."""

import re
from dataclasses import dataclass

from popsim.layout.errors import LayoutError

SMALLEST_SIDE = 50.0
"""mm; below this nothing fits between the margins."""


@dataclass(frozen=True)
class Paper:
    """A sheet of paper: name, width and height in mm."""

    name: str
    width: float
    height: float

    def __post_init__(self) -> None:
        if not min(self.width, self.height) >= SMALLEST_SIDE:
            raise LayoutError(
                f"paper {self.name}: {self.width:g} x {self.height:g} mm is too small; "
                f"both sides must be at least {SMALLEST_SIDE:g} mm"
            )

    @property
    def landscape(self) -> "Paper":
        """The same sheet turned by 90 degrees."""
        return Paper(f"{self.name} landscape", self.height, self.width)


PAPERS = {
    paper.name.lower(): paper
    for paper in (
        Paper("A5", 148.0, 210.0),
        Paper("A4", 210.0, 297.0),
        Paper("A3", 297.0, 420.0),
        Paper("A2", 420.0, 594.0),
        Paper("Letter", 215.9, 279.4),
        Paper("Legal", 215.9, 355.6),
        Paper("Tabloid", 279.4, 431.8),
    )
}
"""Portrait formats by lower-case name."""

_CUSTOM = re.compile(r"(\d+(?:\.\d+)?)\s*x\s*(\d+(?:\.\d+)?)\s*(mm|cm|in)?")
_UNITS = {None: 1.0, "mm": 1.0, "cm": 10.0, "in": 25.4}


def find_paper(name: str) -> Paper:
    """Return the paper called `name`: "A4", "letter landscape", "300x400", "30x40cm", "12x12in".

    Raises
    ------
    LayoutError
        No format is called so; the message lists those that are.
    """
    words = name.strip().lower()
    turned = words.endswith("landscape")
    words = words.removesuffix("landscape").strip()
    custom = _CUSTOM.fullmatch(words)
    if custom:
        unit = _UNITS[custom[3]]
        paper = Paper(words.replace(" ", ""), float(custom[1]) * unit, float(custom[2]) * unit)
    elif words in PAPERS:
        paper = PAPERS[words]
    else:
        known = ", ".join(paper.name for paper in PAPERS.values())
        raise LayoutError(
            f"paper {name!r} is not known; give {known} (each also landscape) or a size as 300x400mm"
        )
    return paper.landscape if turned else paper

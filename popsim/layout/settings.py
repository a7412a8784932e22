"""What can be chosen about a layout."""

from dataclasses import dataclass
from typing import NamedTuple

from popsim.layout.errors import LayoutError
from popsim.layout.paper import Paper
from popsim.layout.registration import REGISTRATIONS
from popsim.layout.thickness import KNIFE, USUAL
from popsim.stock import Stock

FOOTER = 14.0
"""mm above the lower margin kept for legend, scale bar, page number and reproduction line."""

HEADER = 4.0
"""mm below the upper margin kept for the title and the banner."""


class Frame(NamedTuple):
    """A rectangle on a sheet of paper, mm from its lower left corner."""

    left: float
    low: float
    right: float
    high: float

    @property
    def width(self) -> float:
        """From left to right, mm."""
        return self.right - self.left


@dataclass(frozen=True)
class LayoutSettings:
    """Sizes in mm.

    Attributes
    ----------
    margin:
        White border that printers cannot reach.
    gap:
        Least distance between two pieces on a sheet.
    bleed:
        How far pictures reach beyond the outline, so that a cut beside the line leaves no white.
    flap_depth:
        Of a flap where nothing is in its way; never more than half its edge.
    seam_depth:
        Of the flap that joins the parts of a patch too large for the sheet.
    split:
        Divide patches too large for the sheet; else they are refused.
    grain:
        Keep the direction of the paper's grain: it runs along the central fold in all patches, and along the
        longer side of the sheet, so that pieces are turned by half turns only.
    stock:
        The paper; None for common paper that needs no advice, with edges as designed.
    registration:
        Marks and limits of a cutting machine, a name in :data:`popsim.layout.registration.REGISTRATIONS`.
    """

    margin: float = 8.0
    gap: float = 2.0
    bleed: float = 1.0
    flap_depth: float = 5.0
    seam_depth: float = 10.0
    split: bool = True
    grain: bool = False
    stock: Stock | None = None
    registration: str = "none"

    def __post_init__(self) -> None:
        for name in ("margin", "gap", "flap_depth", "seam_depth"):
            value = getattr(self, name)
            if not 0 < value <= 50:
                raise LayoutError(f"{name} must lie above 0 and up to 50 mm, not {value:g}")

        if not 0 <= self.bleed <= 5:
            raise LayoutError(f"bleed must lie between 0 and 5 mm, not {self.bleed:g}")
        if self.registration not in REGISTRATIONS:
            known = ", ".join(REGISTRATIONS)
            raise LayoutError(f"registration marks {self.registration!r} are not known; give {known}")

    @property
    def apart(self) -> float:
        """Least distance between two pieces on a sheet, mm: the gap, or room for the bleed of both."""
        return max(self.gap, 2 * self.bleed)

    @property
    def thickness(self) -> float:
        """Of the paper, mm; of common paper where none is named."""
        return USUAL if self.stock is None else self.stock.thickness

    @property
    def clearance(self) -> float:
        """How far a flap stays inside the outline of its target and off other lines, mm."""
        return KNIFE + self.thickness

    def grain_axis(self, room: tuple[float, float]) -> int | None:
        """Which side of a sheet of this usable area the grain follows: 0 its width, 1 its height; None for any."""
        return int(room[1] >= room[0]) if self.grain else None

    def frame(self, paper: Paper) -> Frame:
        """What of `paper` is printed on at all, texts included.

        Raises
        ------
        LayoutError
            The margins leave nothing.
        """
        machine = REGISTRATIONS[self.registration]
        border = max(self.margin, machine.border)
        short, long = machine.most
        most = (short, long) if paper.width <= paper.height else (long, short)
        width, height = min(paper.width - 2 * border, most[0]), min(paper.height - 2 * border, most[1])
        if min(width, height - HEADER - FOOTER) < 20:
            raise LayoutError(
                f"margins of {border:g} mm leave {width:.0f} x {height - HEADER - FOOTER:.0f} mm of {paper.name}; "
                "use smaller margins or larger paper"
            )
        left, low = (paper.width - width) / 2, (paper.height - height) / 2
        return Frame(left, low, left + width, low + height)

    def area(self, paper: Paper) -> tuple[float, float]:
        """Width and height that pieces may use on `paper`, mm; errors as :meth:`frame`."""
        frame = self.frame(paper)
        return frame.width, frame.high - frame.low - HEADER - FOOTER

    def corner(self, paper: Paper) -> tuple[float, float]:
        """Lower left corner of that area on the sheet, mm from the lower left corner of the paper."""
        frame = self.frame(paper)
        return frame.left, frame.low + FOOTER

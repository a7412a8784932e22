"""What can be chosen about a layout."""

from dataclasses import dataclass

from popsim.layout.errors import LayoutError
from popsim.layout.paper import Paper
from popsim.layout.registration import REGISTRATIONS
from popsim.layout.thickness import KNIFE, USUAL
from popsim.stock import Stock

FOOTER = 13.0
"""mm above the lower margin kept for legend, scale bar, page number and reproduction line."""

HEADER = 4.0
"""mm below the upper margin kept for the title and the banner."""


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
        Keep the direction of the paper's grain: pieces are turned by half turns only.
    stock:
        The paper; None for common paper that needs no advice, with edges as designed.
    registration:
        Marks for a cutting machine, a name in :data:`popsim.layout.registration.REGISTRATIONS`.
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
    def clearance(self) -> float:
        """How far a flap stays inside the outline of its target and off other lines, mm."""
        return KNIFE + (USUAL if self.stock is None else self.stock.thickness)

    @property
    def border(self) -> float:
        """What stays free of pieces and texts all round, mm: the margin, or more for registration marks."""
        return max(self.margin, REGISTRATIONS[self.registration].border)

    def area(self, paper: Paper) -> tuple[float, float]:
        """Width and height that pieces may use on `paper`, mm.

        Raises
        ------
        LayoutError
            The margins leave nothing.
        """
        width = paper.width - 2 * self.border
        height = paper.height - 2 * self.border - HEADER - FOOTER
        if min(width, height) < 20:
            raise LayoutError(
                f"margins of {self.border:g} mm leave {width:.0f} x {height:.0f} mm of {paper.name}; "
                "use smaller margins or larger paper"
            )
        return width, height

    @property
    def corner(self) -> tuple[float, float]:
        """Lower left corner of that area on the sheet, mm from the lower left corner of the paper."""
        return self.border, self.border + FOOTER

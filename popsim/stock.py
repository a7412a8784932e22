"""Stock: what paper weighs, how thick it is, and how it resists bending and folding.

Lengths are mm, forces N. Whatever is not given follows from the grammage, in this order:

- thickness t = grammage / 800 kg/m3: 0.1 mm at 80 g/m2, 0.25 mm at 200 g/m2. Uncoated printing paper and card
  have 700 to 900 kg/m3, coated ones up to 1200, bulky ones down to 600.
- bending stiffness per width B = E t^3 / 12 with E = 4000 N/mm2: 5.2 N mm at 0.25 mm. Machine-made paper has
  about 5 to 9 GPa along its grain and 2 to 4 GPa across; E is the geometric mean, because a pop-up is bent both
  ways. ISO 2493 and ISO 5628 say how makers measure B (their mN m are our N mm).
- crease stiffness per length k = B / (100 t): 0.21 N mm/rad per mm at 0.25 mm. A fold that was creased and
  worked turns like a spring about the angle at which it rests. B / k is the length of flat paper that bends as
  easily as the crease turns; on polymer sheets it exceeds the thickness by about two orders of magnitude
  (Lechenault, Thiria and Adda-Bedia, Phys. Rev. Lett. 112, 244301, 2014). It grows as a crease is worked, and a
  perforated fold is softer: of all values here this is the least certain, by a factor of three either way.

Give measured values where numbers matter.
"""

import re
from dataclasses import dataclass
from typing import Literal

from popsim.errors import InputError

DENSITY = 800.0
"""kg/m3; of uncoated paper and card."""

YOUNGS_MODULUS = 4000.0
"""N/mm2; geometric mean of both directions of the grain."""

CREASE_LENGTH = 100.0
"""Length of flat paper that bends as easily as a crease turns, over the thickness."""

GRAVITY = 9.80665
"""m/s2 (ISO 80000-3)."""

FOLDS_PLAINLY = 0.19
"""mm; thicker paper than this cracks at its folds (printers score from 150 to 170 g/m2 on)."""

SCORES = 0.45
"""mm; board thicker than this does not fold square along a score made by hand."""

THINNEST_STRIP = 2.0
"""mm; strips of paper and holes narrower than this are not cut by hand."""

NEAR_EDGE = 1.5
"""mm; what ends so near to an edge or a hinge goes on to it: a gap beside it cannot be cut either."""

MAY_CROSS = 0.5
"""mm of a hinge beyond which two patches may both go on: on so little paper gives way."""

HINGE_SHARE, HINGE_LENGTH = 0.25, 6.0
"""A hinge holds where it has this share of its line, and this many mm of it (or all of a shorter line)."""


def least_hold(length: float, share: float = HINGE_SHARE, least: float = HINGE_LENGTH) -> float:
    """How much of a line of some length must be held for its hinge to hold, in the unit of both lengths."""
    return min(length, max(least, share * length))


def worth_beyond(*, lies: bool) -> float:
    """What an area of a patch beyond its hinge counts: one that rises is shown by the far side too."""
    return 1.0 if lies else 0.5


CreaseAdvice = Literal["fold", "score", "perforate"]

_RANGES = {
    "grammage": (30.0, 1500.0, "g/m2"),
    "thickness": (0.03, 3.0, "mm"),
    "bending": (1e-3, 1e4, "N mm"),
    "crease": (0.0, 1e3, "N mm/rad per mm"),
}
"""Least and greatest value of each property, and its unit: beyond them it is no paper, or the unit is mistaken."""

_DENSITIES = (200.0, 2000.0)
"""kg/m3; what paper can have, from blotting to photographic paper."""

_STOCK = re.compile(
    r"(?<![\w.])(?P<grammage>\d+(?:\.\d+)?)\s*(?:gsm|g/m2|g/m²)(?:[\s,]+(?P<thickness>\d*\.?\d+)\s*mm)?(?!\w)",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Stock:
    """A kind of paper; see the module for what its values mean.

    Attributes
    ----------
    name:
        What people call it, e.g. "200gsm".
    grammage:
        Mass per area, g/m2.
    thickness:
        mm.
    bending:
        Bending stiffness per width, N mm: moment per width (N mm/mm) over curvature (1/mm).
    crease:
        Stiffness of a crease per length, N mm/rad per mm of crease, which is N.
    """

    name: str
    grammage: float
    thickness: float
    bending: float
    crease: float

    def __post_init__(self) -> None:
        for key, (low, high, unit) in _RANGES.items():
            value = getattr(self, key)
            if not low <= value <= high:
                raise InputError(
                    f"paper {self.name}: {key} must lie between {low:g} and {high:g} {unit}, not {value:g}"
                )
        low, high = _DENSITIES
        density = self.grammage / self.thickness
        if not low <= density <= high:
            raise InputError(
                f"paper {self.name}: {self.grammage:g} g/m2 at {self.thickness:g} mm is {density:.0f} kg/m3; "
                f"paper has {low:g} to {high:g}, so check both"
            )

    @staticmethod
    def of(
        grammage: float,
        *,
        thickness: float | None = None,
        bending: float | None = None,
        crease: float | None = None,
        name: str = "",
    ) -> "Stock":
        """Stock of a grammage in g/m2, with defaults for what is not given.

        Raises
        ------
        InputError
            A value is out of range, or grammage and thickness do not go together.
        """
        thick = grammage / DENSITY if thickness is None else thickness
        stiff = YOUNGS_MODULUS * thick * thick * thick / 12 if bending is None else bending
        spring = stiff / (CREASE_LENGTH * max(thick, 1e-9)) if crease is None else crease
        given = "" if thickness is None else f" {thickness:g}mm"
        return Stock(name or f"{grammage:g}gsm{given}", grammage, thick, stiff, spring)

    @property
    def weight(self) -> float:
        """Weight per area, N/mm2."""
        return self.grammage * 1e-9 * GRAVITY

    @property
    def crease_advice(self) -> CreaseAdvice:
        """How a fold in it is best prepared: plainly folded, scored, or perforated (cut through in dashes)."""
        if self.thickness <= FOLDS_PLAINLY:
            return "fold"
        return "score" if self.thickness <= SCORES else "perforate"


def parse_stock(
    text: str, *, thickness: float | None = None, bending: float | None = None, crease: float | None = None
) -> Stock:
    """Return the stock that `text` names: "200gsm", "200 g/m2", "200gsm 0.25mm".

    Values given beside the text (units as in :class:`Stock`) take the place of what it says or implies.

    Raises
    ------
    InputError
        The text is no stock, or a value is out of range.
    """
    match = _STOCK.fullmatch(text.strip())
    if match is None:
        raise InputError(f"paper {text!r} is no stock; write its weight as 200gsm, or as 200gsm 0.25mm")
    said = None if match["thickness"] is None else float(match["thickness"])
    thick = said if thickness is None else thickness
    return Stock.of(float(match["grammage"]), thickness=thick, bending=bending, crease=crease)


def split_stock(text: str) -> tuple[Stock | None, str]:
    """Take the stock out of a description of paper: "Letter 160gsm" is 160gsm and "Letter".

    Returns None where the text names no stock; what is left of the text may be empty.

    Raises
    ------
    InputError
        A value is out of range.
    """
    match = _STOCK.search(text)
    if match is None:
        return None, text.strip()
    rest = f"{text[: match.start()]} {text[match.end() :]}"
    return parse_stock(match[0]), " ".join(rest.replace(",", " ").split())

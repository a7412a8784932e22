"""The size of the card: both pages contain the open pop-up and the closed one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from popsim.design import Card
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN
from popsim.geometry.rigid import transform
from popsim.layout.paper import PAPERS, find_paper
from popsim.mechanisms import Mechanism

MARGIN = 6.0
"""mm of page that stays free around everything, open and closed."""

STEP = 1.0
"""mm; pages are rounded up to this."""

ANGLES = np.linspace(OPEN, 0.0, 31)


@dataclass(frozen=True)
class Page:
    """A page of the card: its length along the fold and its depth, mm. Folded, the card has this size."""

    along: float
    depth: float

    def __str__(self) -> str:
        return f"{self.along:.0f} x {self.depth:.0f} mm"

    def room(self, reach: FloatArray) -> float:
        """Factor by which what :func:`reached` says may grow on this page, the margins staying as they are."""
        low, high, away = (float(value) for value in reach)
        return min((self.along / 2 - MARGIN) / max(-low, high), (self.depth - MARGIN) / away)


def given_pages(name: str) -> tuple[Page, ...]:
    """The pages that a card may have which, folded, is a paper called `name`.

    A format ("A5") may be folded along either side; "A5 landscape" and a size ("180x120mm") say first how long
    the card is along its fold.

    Raises
    ------
    LayoutError
        No paper is called so.
    """
    paper = find_paper(name)
    page = Page(paper.width, paper.height)
    stated = name.strip().lower() not in PAPERS
    return (page,) if stated else (page, Page(page.depth, page.along))


def reached(mechanisms: Sequence[Mechanism], outlines: dict[str, FloatArray] | None = None) -> FloatArray:
    """How far mechanisms reach while closing: x from, x to, and from the fold (open or closed), mm, shape (3,).

    `outlines` replace the plain faces, by patch id.
    """
    outlines = outlines or {}
    low, high, away = np.inf, -np.inf, 0.0
    for mechanism in mechanisms:
        poses = mechanism.poses(ANGLES)
        for plate in mechanism.plates():
            corners = outlines.get(mechanism.patch_id(plate.role), plate.outline)
            swept = transform(poses[plate.role], corners)
            low, high = min(low, float(swept[..., 0].min())), max(high, float(swept[..., 0].max()))
            away = max(away, float(np.abs(swept[0, :, 1]).max()), float(swept[-1, :, 2].max()))
    return np.array([low, high, away])


def fitting_card(
    mechanisms: Sequence[Mechanism], outlines: dict[str, FloatArray] | None = None, page: Page | None = None
) -> Card:
    """The smallest card, in whole millimetres, that holds everything with a margin; or the one with given pages.

    Symmetric about x = 0.
    """
    if page is not None:
        return Card(x=(-page.along / 2, page.along / 2), depth=page.depth)
    needed = needed_page(reached(mechanisms, outlines))
    half = float(np.ceil(needed.along / 2 / STEP) * STEP)
    return Card(x=(-half, half), depth=float(np.ceil(needed.depth / STEP) * STEP))


def needed_page(reach: FloatArray) -> Page:
    """The smallest page for what :func:`reached` says, margins included."""
    low, high, away = (float(value) for value in reach)
    return Page(2 * (max(-low, high) + MARGIN), away + MARGIN)

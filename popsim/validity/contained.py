"""Closed, nothing sticks out of the card (not in the paper; everyone who closes a card expects it)."""

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Design
from popsim.mechanisms import Condition
from popsim.validity.reach import OutlineReach

EDGE = 1e-6
"""mm; a patch may end at the edge of the page."""


def contained_conditions(design: Design, reach: OutlineReach) -> list[Condition]:
    """For each mechanism: the closed pose of its outlines lies within the pages."""
    (x0, x1), depth = _covered(design)
    conditions = []
    for name, swept in reach.swept.items():
        closed = swept[-1]
        up = depth - float(closed[:, 2].max())
        along = min(float(closed[:, 0].min()) - x0, x1 - float(closed[:, 0].max()))
        conditions.append(Condition("contained", name, "closed within the depth of the page", up + EDGE))
        conditions.append(Condition("contained", name, "closed within the width of the page", along + EDGE))
    return conditions


def _covered(design: Design) -> tuple[tuple[float, float], float]:
    """Extent along the central fold and depth that both pages have, mm.

    That of the card, but for pages that are cut smaller; no page is larger (:mod:`popsim.design.rules`).
    """
    pages = [design.patch_by_id[page].points for page in (GROUND_ID, BACKDROP_ID)]
    x0, x1 = (max(page[:, 0].min() for page in pages), min(page[:, 0].max() for page in pages))
    return (float(x0), float(x1)), float(min(np.abs(page[:, 1]).max() for page in pages))

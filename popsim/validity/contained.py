"""Closed, nothing sticks out of the card (not in the paper; everyone who closes a card expects it)."""

from popsim.design import Design
from popsim.mechanisms import Condition
from popsim.validity.reach import OutlineReach

EDGE = 1e-6
"""mm; a patch may end at the edge of the page."""


def contained_conditions(design: Design, reach: OutlineReach) -> list[Condition]:
    """For each mechanism: the closed pose of its outlines lies within the pages."""
    (x0, x1), depth = design.card.x, design.card.depth
    conditions = []
    for name, swept in reach.swept.items():
        closed = swept[-1]
        up = depth - float(closed[:, 2].max())
        along = min(float(closed[:, 0].min()) - x0, x1 - float(closed[:, 0].max()))
        conditions.append(Condition("contained", name, "closed within the depth of the page", up + EDGE))
        conditions.append(Condition("contained", name, "closed within the width of the page", along + EDGE))
    return conditions

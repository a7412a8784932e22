"""Orders in which pieces are placed: largest first by several measures, and small changes to good ones."""

from collections.abc import Callable, Mapping
from enum import IntEnum
from random import Random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapely.geometry import Polygon

MEASURES: tuple[Callable[["Polygon"], float], ...] = (
    lambda shape: float(shape.area),
    lambda shape: float(shape.envelope.area),
    lambda shape: float(shape.convex_hull.area),
)
"""Largest first, by these."""

VARIED = 3
"""Orders by sizes varied at random, beside those by plain measures."""

SMALLEST_SHARE = 0.4
"""Varied, a piece counts as this share of its size at least: large ones still go early."""

OTHER_SHEETS = 0.15
"""How often a change is to the order of the sheets too."""


class First(IntEnum):
    """Which sheets a piece tries first: the oldest, those before the last that need it, or that need it most."""

    OLDEST = 0
    NEEDY = 1
    NEEDIEST = 2


class Order(NamedTuple):
    """How pieces are placed one after another.

    Attributes
    ----------
    pieces:
        Their indices, in this order.
    sheets:
        Which sheet each tries first.
    """

    pieces: tuple[int, ...]
    sheets: "First"

    def changed(self, random: Random) -> "Order":
        """A neighbour: one or two pieces go earlier or later, or change places."""
        pieces = list(self.pieces)
        for _ in range(random.choice((1, 1, 2))):
            one, other = random.randrange(len(pieces)), random.randrange(len(pieces))
            if random.random() < 0.5:
                pieces[one], pieces[other] = pieces[other], pieces[one]
            else:
                pieces.insert(other, pieces.pop(one))
        sheets = random.choice(tuple(First)) if random.random() < OTHER_SHEETS else self.sheets
        return Order(tuple(pieces), sheets)


def first_orders(shapes: Mapping[int, "Polygon"], random: Random, varied: int = VARIED) -> tuple[Order, ...]:
    """Orders of shapes, given by their indices, to begin with; each once. `varied` of the sizes are at random."""
    indices = list(shapes)
    found: dict[Order, None] = {}
    for turn in range(len(MEASURES) + varied):
        sizes = [MEASURES[turn % len(MEASURES)](shape) for shape in shapes.values()]
        if turn >= len(MEASURES):
            sizes = [size * random.uniform(SMALLEST_SHARE, 1.0) for size in sizes]
        pieces = tuple(indices[k] for k in np.argsort(-np.array(sizes), kind="stable"))
        found |= dict.fromkeys(Order(pieces, sheets) for sheets in First)
    return tuple(found)

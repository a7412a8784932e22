"""Orders in which pieces are placed: largest first by several measures, and small changes to good ones."""

from collections.abc import Callable
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


class Order(NamedTuple):
    """How pieces are placed one after another.

    Attributes
    ----------
    pieces:
        Their indices, in this order.
    needy:
        Whether each goes to sheets first that are not well filled, but for the last; otherwise to the first sheet
        with room for it.
    """

    pieces: tuple[int, ...]
    needy: bool

    def changed(self, random: Random) -> "Order":
        """A neighbour: one or two pieces go earlier or later, or change places."""
        pieces = list(self.pieces)
        for _ in range(random.choice((1, 1, 2))):
            one, other = random.randrange(len(pieces)), random.randrange(len(pieces))
            if random.random() < 0.5:
                pieces[one], pieces[other] = pieces[other], pieces[one]
            else:
                pieces.insert(other, pieces.pop(one))
        return Order(tuple(pieces), self.needy != (random.random() < OTHER_SHEETS))


def first_orders(shapes: list["Polygon"], random: Random) -> tuple[Order, ...]:
    """Orders to begin with, each once."""
    found: dict[Order, None] = {}
    for turn in range(len(MEASURES) + VARIED):
        sizes = [MEASURES[turn % len(MEASURES)](shape) for shape in shapes]
        if turn >= len(MEASURES):
            sizes = [size * random.uniform(SMALLEST_SHARE, 1.0) for size in sizes]
        pieces = tuple(int(k) for k in np.argsort(-np.array(sizes), kind="stable"))
        found |= dict.fromkeys((Order(pieces, needy=False), Order(pieces, needy=True)))
    return tuple(found)

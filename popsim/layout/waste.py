"""What a nesting wastes, as a number to make small."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray

WELL_FILLED = 0.55
"""Share of the area that pieces should take on every sheet but the last."""


class Waste(NamedTuple):
    """What a nesting wastes; less is better.

    Attributes
    ----------
    sheets:
        Their number.
    lacking:
        What all but the last lack to be well filled, in sheets.
    last:
        How full the emptiest is, 0..1.
    even:
        How evenly the others are filled, negative.
    emptiest:
        Indices of the last sheet and of those that are not well filled.
    """

    sheets: int
    lacking: float
    last: float
    even: float
    emptiest: tuple[int, ...]


def taken_of(shares: Sequence[float], sheets: Sequence[int]) -> FloatArray:
    """How much shapes take of each sheet, of what each takes and the index of its sheet, shape (n,)."""
    taken = np.zeros(max(sheets, default=-1) + 1)
    np.add.at(taken, np.asarray(sheets, dtype=np.int64), shares)
    return taken


def waste_of(shares: Sequence[float], sheets: Sequence[int]) -> Waste:
    """What a nesting wastes: of the share of a sheet that each shape takes, and the index of its sheet."""
    filled = taken_of(shares, sheets)
    rank = np.argsort(filled, kind="stable")
    lacking = np.maximum(WELL_FILLED - filled[rank[1:]], 0.0)
    emptiest = tuple(int(k) for k in (*rank[:1], *rank[1:][lacking > 0]))
    return Waste(
        len(filled), float(lacking.sum()), float(filled.min(initial=1.0)), -float((filled**2).sum()), emptiest
    )

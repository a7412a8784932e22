"""Marks by which a cutting machine finds the print. A new machine is one row of the table."""

from collections.abc import Callable, Iterator
from math import inf
from typing import NamedTuple

import numpy as np

from popsim.layout.paper import Paper
from popsim.layout.sheet import Area, Line, Mark, Role

INSET = 10.0
"""mm from the edges of the paper to the marks (Silhouette's usual setting)."""

SQUARE = 5.0
"""mm; side of the square in the upper left corner."""

ARM = 20.0
"""mm; length of the arms of the two other marks."""


INCH = 25.4


class Registration(NamedTuple):
    """What a machine needs.

    Attributes
    ----------
    border:
        mm that must stay free all round, for its marks.
    marks:
        Draws them.
    most:
        Shorter and longer side of what it takes at once, mm; the middle of the paper is used.
    """

    border: float
    marks: Callable[[Paper], Iterator[Mark]]
    most: tuple[float, float] = (inf, inf)


def _silhouette(paper: Paper) -> Iterator[Mark]:
    """A filled square in the upper left corner, and angles in the upper right and lower left corners."""
    left, right, low, high = INSET, paper.width - INSET, INSET, paper.height - INSET
    square = [[left, high], [left + SQUARE, high], [left + SQUARE, high - SQUARE], [left, high - SQUARE]]
    yield Area(Role.REGISTRATION, (np.array(square),))
    yield Line(Role.REGISTRATION, np.array([[right - ARM, high], [right, high], [right, high - ARM]]))
    yield Line(Role.REGISTRATION, np.array([[left, low + ARM], [left, low], [left + ARM, low]]))


def _none(paper: Paper) -> Iterator[Mark]:
    yield from ()


REGISTRATIONS = {
    "none": Registration(0.0, _none),
    "silhouette": Registration(INSET + SQUARE + 1.0, _silhouette),
    "cricut": Registration(0.0, _none, most=(6.75 * INCH, 9.25 * INCH)),
}
"""By name. Cricut's software adds its marks itself, round what it takes for print-then-cut."""

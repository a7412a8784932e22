"""Marks by which a cutting machine finds the print. A new machine is one row of the table."""

from collections.abc import Callable, Iterator
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


class Registration(NamedTuple):
    """Marks of a machine, and the border in mm that must stay free for them."""

    border: float
    marks: Callable[[Paper], Iterator[Mark]]


def _silhouette(paper: Paper) -> Iterator[Mark]:
    """A filled square in the upper left corner, and angles in the upper right and lower left corners."""
    left, right, low, high = INSET, paper.width - INSET, INSET, paper.height - INSET
    square = [[left, high], [left + SQUARE, high], [left + SQUARE, high - SQUARE], [left, high - SQUARE]]
    yield Area(Role.REGISTRATION, (np.array(square),))
    yield Line(Role.REGISTRATION, np.array([[right - ARM, high], [right, high], [right, high - ARM]]))
    yield Line(Role.REGISTRATION, np.array([[left, low + ARM], [left, low], [left + ARM, low]]))


def _none(paper: Paper) -> Iterator[Mark]:
    yield from ()


REGISTRATIONS = {"none": Registration(0.0, _none), "silhouette": Registration(INSET + SQUARE + 1.0, _silhouette)}
"""By name."""

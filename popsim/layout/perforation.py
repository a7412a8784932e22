"""Creases that are cut through in dashes, for board too thick to be scored."""

from collections.abc import Iterator

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import Line, Role

DASHES = {Role.MOUNTAIN: (4.0, 1.2), Role.VALLEY: (2.0, 1.0)}
"""mm that are cut, and left between two cuts: the two kinds of crease are told apart by their lengths."""


def perforation(role: Role, ends: FloatArray) -> Iterator[Line]:
    """The cuts of a crease between `ends` (2, 2), a bridge at either end; a crease too short for one stays a line.

    Cuts are as long as DASHES says or a little longer, so that they fill the crease evenly.
    """
    cut, left = DASHES[role]
    length = float(np.linalg.norm(ends[1] - ends[0]))
    count = int((length - left) // (cut + left))
    if not count:
        yield Line(role, ends)
        return
    period = (length - left) / count
    direction = (ends[1] - ends[0]) / length
    for k in range(count):
        start = left + k * period
        yield Line(role, ends[0] + np.array([[start], [start + period - left]]) * direction)

"""Shapes of plates: what tells them apart by how they show a model."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Plate

DIGITS = 6
"""Decimals of mm by which corners are told apart."""

ACROSS = np.array([1.0, -1.0, 1.0])
"""Takes points to the other side of the fold."""


class Shape(NamedTuple):
    """What tells a plate from others by how it shows a model; its fields as :class:`Plate` has them.

    Attributes
    ----------
    key:
        The same for plates of one shape.
    """

    outline: FloatArray
    room: FloatArray
    outward: FloatArray
    hinges: FloatArray
    behind: float
    beside: float
    principal: bool
    lies: bool
    key: bytes


@lru_cache(maxsize=8192)
def shape_of(plate: Plate, *, across: bool) -> Shape:
    """The shape of a plate, or of its mirror image where `across`: corners and hinges rounded and in one order."""
    assert plate.room is not None  # plates give themselves room
    places = np.concatenate([plate.outline, plate.room, plate.hinges.reshape(-1, 3), plate.outward[None]])
    points = (np.round(places * ACROSS if across else places, DIGITS) + 0.0).tolist()
    first, second = len(plate.outline), len(plate.outline) + len(plate.room)
    ends = points[second:-1]
    hinges = sorted({(*low, *high) for low, high in (sorted(ends[k : k + 2]) for k in range(0, len(ends), 2))})
    corners = _ring(points[:first]), _ring(points[first:second]), points[-1], hinges
    outline, room, outward, lines = (np.array(part, dtype=np.float64) for part in corners)
    depths = round(plate.behind, DIGITS), round(plate.beside, DIGITS)
    rest = np.array([*depths, plate.principal, plate.lies, len(outline), len(room)], dtype=np.float64)
    key = b"".join(part.tobytes() for part in (outline, room, outward, lines, rest))
    return Shape(outline, room, outward, lines.reshape(-1, 2, 3), *depths, plate.principal, plate.lies, key)


def _ring(corners: list[list[float]]) -> list[list[float]]:
    """Corners of a ring from its least one on, to the side of the lesser neighbour: whatever way it is listed."""
    first = corners.index(min(corners))
    turned = corners[first:] + corners[:first]
    return [turned[0], *turned[:0:-1]] if turned[-1] < turned[1] else turned

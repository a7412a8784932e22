"""Shapes of plates: what tells them apart by how they show a model."""

from functools import lru_cache
from struct import pack
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
    taken: FloatArray
    behind: float
    beside: float
    principal: bool
    lies: bool
    key: bytes


@lru_cache(maxsize=8192)
def shape_of(plate: Plate, *, across: bool) -> Shape:
    """The shape of a plate, or of its mirror image where `across`, rounded."""
    assert plate.room is not None  # plates give themselves room
    places = np.concatenate([plate.outline, plate.room, plate.outward[None], plate.hinges.reshape(-1, 3)])
    points = (places * ACROSS if across else places).round(DIGITS) + 0.0  # there is no negative zero
    first, second = len(plate.outline), len(plate.outline) + len(plate.room)
    outline, room, outward, ends = points[:first], points[first:second], points[second], points[second + 1 :]
    taken, depths = plate.taken.round(DIGITS), (round(plate.behind, DIGITS), round(plate.beside, DIGITS))
    rest = pack("dd??qq", *depths, plate.principal, plate.lies, first, second)
    key = points.tobytes() + taken.tobytes() + rest
    return Shape(outline, room, outward, ends.reshape(-1, 2, 3), taken, *depths, plate.principal, plate.lies, key)

"""The two primitives of Sec. 4.1, under constraints 1 and 2, and rows of rectangular ones."""

from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Literal

import numpy as np

from popsim.errors import GeometryError

Corner = tuple[float, float, float]


@dataclass(frozen=True)
class RectangularPrism:
    """A box whose side edges are parallel or orthogonal to the central fold, card frame, mm.

    Attributes
    ----------
    low, high:
        Opposite corners; with `turned` the corners of the box around it.
    turned:
        False: all edges along the axes. True: turned by 45 degrees about z, its base a square standing on a
        corner (the whole v-fold of Fig. 5c).
    """

    low: Corner
    high: Corner
    turned: bool = False

    kind = "rectangular"

    def __post_init__(self) -> None:
        size = _size(self.low, self.high)
        if self.turned and abs(size[0] - size[1]) > 1e-6 * max(size[0], size[1]):
            raise GeometryError(f"a turned prism stands on a square, not on {size[0]:g} x {size[1]:g} mm")

    def face_areas(self) -> tuple[float, ...]:
        """Area of each of its faces, mm^2."""
        x, y, z = _size(self.low, self.high)
        if self.turned:
            x = y = x / float(np.sqrt(2))
        return (x * y, x * y, x * z, x * z, y * z, y * z)


@dataclass(frozen=True)
class PrismRow:
    """Rectangular prisms of one width that adjoin along x on one level: what layers represent (Sec. 4.3).

    Attributes
    ----------
    half_width:
        All reach from -half_width to half_width in y, mm.
    base:
        Height they stand on, mm.
    tops:
        (x0, x1, height above the base) of each, adjoining, mm.
    """

    half_width: float
    base: float
    tops: tuple[tuple[float, float, float], ...]

    kind = "rectangular"

    def __post_init__(self) -> None:
        for prism in self.prisms():
            _size(prism.low, prism.high)
        if not self.tops:
            raise GeometryError("a row needs at least one prism")
        if any(left[1] != right[0] for left, right in pairwise(self.tops)):
            raise GeometryError("the prisms of a row adjoin; found a gap or an overlap")

    def prisms(self) -> tuple[RectangularPrism, ...]:
        """The prisms one by one."""
        w, z = self.half_width, self.base
        return tuple(RectangularPrism((x0, -w, z), (x1, w, z + height)) for x0, x1, height in self.tops)

    def face_areas(self) -> tuple[float, ...]:
        """Area of each face of the whole row, bottom and steps included, mm^2."""
        profile = sum((x1 - x0) * height for x0, x1, height in self.tops)
        across = 2 * self.half_width
        levels = [0.0, *(height for _, _, height in self.tops), 0.0]
        steps = [abs(b - a) * across for a, b in pairwise(levels)]
        tops = [(x1 - x0) * across for x0, x1, _ in self.tops]
        return (profile, profile, *steps, *tops, sum(tops))


@dataclass(frozen=True)
class TriangularPrism:
    """A prism with an isosceles triangle as section, card frame, mm.

    Attributes
    ----------
    low, high:
        Opposite corners of the box around it.
    edges:
        Direction of its three side edges. "x": a roof whose ridge lies over y = 0 (tent-fold). "z": an upright
        wedge with its tip at one end of the box (half a v-fold, Fig. 5d).
    facing:
        Only for "z": to which end of x the tip points, 1 or -1.
    """

    low: Corner
    high: Corner
    edges: Literal["x", "z"]
    facing: Literal[1, -1] = 1

    kind = "triangular"

    def __post_init__(self) -> None:
        _size(self.low, self.high)

    def face_areas(self) -> tuple[float, ...]:
        """Area of each of its five faces, mm^2."""
        x, y, z = _size(self.low, self.high)
        base, height, length = (y, z, x) if self.edges == "x" else (y, x, z)
        slope = float(np.hypot(base / 2, height))
        return (base * height / 2, base * height / 2, base * length, slope * length, slope * length)


Primitive = RectangularPrism | PrismRow | TriangularPrism


def _size(low: Corner, high: Corner) -> tuple[float, float, float]:
    """Extent along x, y, z.

    Raises
    ------
    GeometryError
        An extent is not positive.
    """
    x, y, z = (float(b) - float(a) for a, b in zip(low, high, strict=True))
    if not (0 < x < inf and 0 < y < inf and 0 < z < inf):
        raise GeometryError(f"a prism needs a positive size, not {[x, y, z]} mm")
    return x, y, z

"""The two primitives of Sec. 4.1, under constraints 1 and 2."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.errors import GeometryError


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

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    turned: bool = False

    kind = "rectangular"

    def __post_init__(self) -> None:
        size = np.subtract(self.high, self.low)
        if not (np.isfinite(size).all() and (size > 0).all()):
            raise GeometryError(f"a rectangular prism needs a positive size, not {size.tolist()} mm")
        if self.turned and abs(size[0] - size[1]) > 1e-6 * max(size[0], size[1]):
            raise GeometryError(f"a turned prism stands on a square, not on {size[0]:g} x {size[1]:g} mm")

    def face_areas(self) -> tuple[float, ...]:
        """Area of each of its six faces, mm^2."""
        x, y, z = np.subtract(self.high, self.low)
        if self.turned:
            x = y = x / np.sqrt(2)
        return (x * y, x * y, x * z, x * z, y * z, y * z)


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

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    edges: Literal["x", "z"]
    facing: Literal[1, -1] = 1

    kind = "triangular"

    def __post_init__(self) -> None:
        size = np.subtract(self.high, self.low)
        if not (np.isfinite(size).all() and (size > 0).all()):
            raise GeometryError(f"a triangular prism needs a positive size, not {size.tolist()} mm")

    def face_areas(self) -> tuple[float, ...]:
        """Area of each of its five faces, mm^2."""
        x, y, z = np.subtract(self.high, self.low)
        base, height, length = (y, z, x) if self.edges == "x" else (y, x, z)
        slope = np.hypot(base / 2, height)
        return (base * height / 2, base * height / 2, base * length, slope * length, slope * length)


Primitive = RectangularPrism | TriangularPrism

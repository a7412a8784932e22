"""An orthographic view: where the image plane lies in space, and how it is divided into pixels.

Plane coordinates are (x, y, depth): x to the right, y up, depth away from the eye, all from the view's
origin and in the unit of the model. Pixel coordinates are (column, row) from the upper-left corner of the
image; the centre of the first pixel is (0.5, 0.5).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked

WHOLE_PIXEL = 1e-6  # a width of 100.0000001 pixels is 100, not 101


@dataclass(frozen=True, eq=False)
class View:
    """Parallel rays that look along -`eye` through a rectangle of the image plane.

    Attributes
    ----------
    eye:
        Unit direction from the object to the eye, shape (3,); normalised on entry.
    up:
        Unit direction that is up in the image, square to `eye`, shape (3,); squared on entry.
    origin:
        Point of space with plane coordinates (0, 0, 0), shape (3,).
    low:
        Plane coordinates (x, y) of the lower-left corner of the image, shape (2,).
    size:
        Width and height that the image covers at least, shape (2,). Where they are no whole number of
        pixels, the image reaches less than a pixel further to the right and up.
    pixels_per_unit:
        Resolution, pixels per unit of length.
    """

    eye: FloatArray
    up: FloatArray
    origin: FloatArray
    low: FloatArray
    size: FloatArray
    pixels_per_unit: float

    def __post_init__(self) -> None:
        eye = _unit(locked(self.eye, (3,), "eye"), "eye")
        up = locked(self.up, (3,), "up")
        up = _unit(up - (up @ eye) * eye, "up, seen along the eye direction,")
        object.__setattr__(self, "eye", locked(eye, (3,), "eye"))
        object.__setattr__(self, "up", locked(up, (3,), "up"))
        object.__setattr__(self, "origin", locked(self.origin, (3,), "origin"))
        object.__setattr__(self, "low", locked(self.low, (2,), "low"))
        object.__setattr__(self, "size", locked(self.size, (2,), "size"))
        if not (self.size > 0).all() or not self.pixels_per_unit > 0:
            raise GeometryError(
                f"a view needs a positive size and resolution, not {self.size.tolist()} at "
                f"{self.pixels_per_unit} pixels per unit"
            )

    @classmethod
    def framing(
        cls,
        points: npt.ArrayLike,
        *,
        eye: npt.ArrayLike,
        up: npt.ArrayLike,
        pixels_per_unit: float,
        margin: float = 0.0,
        origin: npt.ArrayLike = (0.0, 0.0, 0.0),
    ) -> "View":
        """Return the view whose image holds all `points` (n, 3) with `margin` (in units) around them."""
        unit = cls(np.asarray(eye), np.asarray(up), np.asarray(origin), np.zeros(2), np.ones(2), 1.0)
        plane = unit.to_plane(points).reshape(-1, 3)[:, :2]
        low, high = plane.min(axis=0) - margin, plane.max(axis=0) + margin
        smallest = 1.0 / pixels_per_unit  # what is seen edge-on still gets a pixel
        return cls(unit.eye, unit.up, unit.origin, low, np.maximum(high - low, smallest), pixels_per_unit)

    @cached_property
    def right(self) -> FloatArray:
        """Unit direction to the right in the image, shape (3,)."""
        return np.cross(self.up, self.eye)

    @property
    def pixel(self) -> float:
        """Side of a pixel in units of length."""
        return 1.0 / self.pixels_per_unit

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the image."""
        width, height = np.ceil(self.size * self.pixels_per_unit - WHOLE_PIXEL).astype(int)
        return max(1, int(height)), max(1, int(width))

    @cached_property
    def _axes(self) -> FloatArray:
        return np.array([self.right, self.up, -self.eye])

    def to_plane(self, points: npt.ArrayLike) -> FloatArray:
        """Return (x, y, depth) of points in space; both of shape (..., 3)."""
        relative = np.asarray(points, dtype=np.float64) - self.origin
        plane: FloatArray = relative @ self._axes.T
        return plane

    def to_space(self, plane: npt.ArrayLike) -> FloatArray:
        """Return points in space of (x, y, depth); both of shape (..., 3)."""
        points: FloatArray = np.asarray(plane, dtype=np.float64) @ self._axes + self.origin
        return points

    def to_pixel(self, plane: npt.ArrayLike) -> FloatArray:
        """Return (column, row) of plane points (x, y); both of shape (..., 2)."""
        xy = np.asarray(plane, dtype=np.float64) - self.low
        rows = self.shape[0]
        return np.stack([xy[..., 0] * self.pixels_per_unit, rows - xy[..., 1] * self.pixels_per_unit], -1)

    def from_pixel(self, pixel: npt.ArrayLike) -> FloatArray:
        """Return plane points (x, y) of (column, row); both of shape (..., 2)."""
        at = np.asarray(pixel, dtype=np.float64)
        rows = self.shape[0]
        return np.stack([at[..., 0], rows - at[..., 1]], -1) * self.pixel + self.low

    def pixel_centres(self) -> FloatArray:
        """Return plane points (x, y) of the centres of all pixels, shape (rows, columns, 2)."""
        rows, columns = self.shape
        column, row = np.meshgrid(np.arange(columns) + 0.5, np.arange(rows) + 0.5)
        return self.from_pixel(np.stack([column, row], -1))


def _unit(vector: FloatArray, name: str) -> FloatArray:
    length = float(np.linalg.norm(vector))
    if length < 1e-12:  # a direction cannot be told from rounding noise
        raise GeometryError(f"{name} has no direction; give a vector that is not zero (nor along the eye)")
    return vector / length

"""A camera in space, perspective or orthographic."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, IntArray, locked

AXES = "xyz"


@dataclass(frozen=True, eq=False)
class Camera:
    """Looks from `position` at `target`.

    Attributes
    ----------
    position, target:
        Points in space, shape (3,) each.
    up:
        What is up in the picture, shape (3,); made square to the line of sight on entry.
    height:
        How much of the plane through the target (square to the line of sight) the picture shows from its
        lower to its upper edge, in units of length.
    perspective:
        False for parallel rays.
    """

    position: FloatArray
    target: FloatArray
    up: FloatArray
    height: float
    perspective: bool = True

    def __post_init__(self) -> None:
        for name in ("position", "target", "up"):
            object.__setattr__(self, name, locked(getattr(self, name), (3,), f"camera {name}"))
        if not self.distance > 0 or not self.height > 0:
            raise GeometryError("a camera needs a target that is not its position, and a positive height")
        up = self.up - (self.up @ self.eye) * self.eye
        length = float(np.linalg.norm(up))
        if length < 1e-9 * max(1.0, float(np.linalg.norm(self.up))):
            raise GeometryError("the up direction of a camera must not lie along its line of sight")
        object.__setattr__(self, "up", locked(up / length, (3,), "camera up"))

    @classmethod
    def looking_at(
        cls,
        bounds: npt.ArrayLike,
        azimuth_deg: float = 35.0,
        elevation_deg: float = 25.0,
        field_of_view_deg: float = 28.0,
        *,
        aspect: float = 4 / 3,
        margin: float = 0.06,
        up: str = "z",
    ) -> "Camera":
        """Return the camera nearest to the box `bounds` (2, 3) that shows all of it.

        Parameters
        ----------
        bounds:
            Lowest and highest corner.
        azimuth_deg:
            Angle of the eye about the up axis, right-handed; 0 is x for z up, z for y up, y for x up.
        elevation_deg:
            Angle of the eye above the horizon, within -90..90.
        field_of_view_deg:
            Vertical angle of view; 0 for parallel rays.
        aspect:
            Width of the picture by its height.
        margin:
            Share of the picture left free at each border.
        up:
            "x", "y" or "z".

        Raises
        ------
        GeometryError
            The bounds are no box, or a number lies outside its range.
        """
        low, high = locked(bounds, (2, 3), "bounds")
        if up not in AXES or not 0 <= field_of_view_deg < 180 or not 0 <= margin < 0.5 or not aspect > 0:
            raise GeometryError(
                f"expected up x, y or z, a field of view in [0, 180) deg, a margin in [0, 0.5) and a positive "
                f"aspect; found {up}, {field_of_view_deg}, {margin}, {aspect}"
            )
        eye, upward = _directions(np.radians(azimuth_deg), np.radians(elevation_deg), AXES.index(up))
        axes = np.array([np.cross(upward, eye), upward, eye])  # right, up, to the eye
        corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T @ axes.T
        middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
        slack = max(float(np.ptp(corners, axis=0).max()), 1e-9)
        if field_of_view_deg == 0:
            spans = np.ptp(corners[:, :2], axis=0) / (1 - 2 * margin)
            height = max(float(spans[1]), float(spans[0]) / aspect, 1e-6 * slack)
            position = middle + np.array([0.0, 0.0, 2 * slack])
            return cls(position @ axes, middle @ axes, upward, height, perspective=False)
        tangent = np.tan(np.radians(field_of_view_deg) / 2)
        position = _nearest(corners, (1 - 2 * margin) * tangent * np.array([aspect, 1.0]), 1e-3 * slack)
        target = np.array([position[0], position[1], middle[2]])
        return cls(position @ axes, target @ axes, upward, 2 * tangent * float(position[2] - middle[2]))

    @property
    def distance(self) -> float:
        """From the position to the target."""
        return float(np.linalg.norm(self.position - self.target))

    @property
    def eye(self) -> FloatArray:
        """Unit direction from the target to the position, shape (3,)."""
        return (self.position - self.target) / self.distance

    @property
    def right(self) -> FloatArray:
        """Unit direction to the right in the picture, shape (3,)."""
        return np.cross(self.up, self.eye)

    def rays(self, rows: int, columns: int, which: slice | IntArray) -> tuple[FloatArray, FloatArray]:
        """Return origins (n, 3) and directions (n, 3) through pixels of a picture, counted row by row.

        The directions are one unit long along the line of sight, so that a distance counted in them is the
        depth.
        """
        numbers = np.arange(*which.indices(rows * columns)) if isinstance(which, slice) else which
        row, column = np.divmod(numbers, columns)
        pixel = self.height / rows
        x, y = (column + 0.5 - columns / 2) * pixel, (rows / 2 - row - 0.5) * pixel
        across = x[:, None] * self.right + y[:, None] * self.up
        if self.perspective:
            return np.broadcast_to(self.position, across.shape), across / self.distance - self.eye
        return self.position + across, np.broadcast_to(-self.eye, across.shape)

    def pixel_size(self, rows: int, depth: FloatArray) -> FloatArray:
        """Return the side of a pixel at a depth, in units of length; both of the same shape."""
        pixel = self.height / rows
        return depth * (pixel / self.distance) if self.perspective else np.full_like(depth, pixel)


def _directions(azimuth: float, elevation: float, axis: int) -> tuple[FloatArray, FloatArray]:
    """Return the direction to the eye and up in the picture, (3,) each; `axis` is the one that points up."""
    ahead = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    zenith = np.array([0.0, 0.0, 1.0])
    eye = np.cos(elevation) * ahead + np.sin(elevation) * zenith
    upward = np.cos(elevation) * zenith - np.sin(elevation) * ahead
    return np.roll(eye, axis - 2), np.roll(upward, axis - 2)


def _nearest(corners: FloatArray, tangents: FloatArray, near: float) -> FloatArray:
    """Return the lowest position (x, y, z) from which all corners lie within the tangents (2,) of view.

    A corner at (p, z) is inside if |p - x| <= (Z - z) t, hence p + z t - x <= Z t and x - p + z t <= Z t.
    """
    spread = corners[:, 2:] * tangents
    high = (corners[:, :2] + spread).max(axis=0)
    low = (corners[:, :2] - spread).min(axis=0)
    z = max(float(((high - low) / (2 * tangents)).max()), float(corners[:, 2].max()) + near)
    return np.array([*(high + low) / 2, z])

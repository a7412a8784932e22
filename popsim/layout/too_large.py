"""What exceeds a sheet, and the scale at which it would go onto it."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout.errors import LayoutError

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

Room = tuple[float, float]
"""Width and height of the usable area of a sheet, mm."""


def fits(shape: "BaseGeometry", room: Room, allowance: float | FloatArray, *, grain: bool = False) -> bool:
    """Whether `shape` goes into `room` upright, turned by 90 degrees, or aslant; with `grain` upright only.

    `allowance` is what flaps may add, mm, or how much along either axis, (2,).
    """
    upright, *aslant = _sizes(shape, grain)
    wanted = [upright + allowance, *(size + np.max(allowance) for size in aslant)]
    return bool(upright.min() > 0) and any(
        bool((size <= sides).all()) for size in wanted for sides in sides_of(room, grain)
    )


def too_large(
    name: str, bare: "Polygon", with_flaps: "Polygon", room: Room, *, grain: bool, why: str = ""
) -> LayoutError:
    """The refusal of what does not go onto a sheet; it states the scale that would.

    Parameters
    ----------
    bare, with_flaps:
        Its shape without flaps, which a scale makes smaller, and with them, which keep their depth.
    why:
        Why nothing can be done about it, where something might.
    """
    size = np.array(_sizes(bare, grain)[0])
    return LayoutError(
        f"{name} measures {size.min():.1f} x {size.max():.1f} mm without flaps, more than the {room[0]:.0f} x "
        f"{room[1]:.0f} mm within the margins hold{why and f', and {why}'}; scale the design by "
        f"{_fitting_scale(bare, with_flaps, room, grain):.3f} or less, or use larger paper"
    )


def _fitting_scale(bare: "Polygon", with_flaps: "Polygon", room: Room, grain: bool) -> float:
    """The largest scale at which `bare` goes into `room` with flaps as deep as they are, in steps of 0.001."""
    found = [
        float(((sides - (whole - size)) / size).min())
        for size, whole in zip(_sizes(bare, grain), _sizes(with_flaps, grain), strict=True)
        for sides in sides_of(room, grain)
    ]
    return float(np.floor(1000 * max(found)) / 1000)


def sides_of(room: Room, grain: bool) -> tuple[FloatArray, ...]:
    """Sides of the area, (2,), as it is and, but for `grain`, turned by 90 degrees."""
    return (np.array(room),) if grain else (np.array(room), np.array(room[::-1]))


def _sizes(shape: "BaseGeometry", grain: bool) -> tuple[FloatArray, ...]:
    """Width and height of a shape, and sides of the smallest rectangle round it, the shorter first, each (2,)."""
    low_x, low_y, high_x, high_y = shape.bounds
    upright = np.array([high_x - low_x, high_y - low_y])
    if grain:
        return (upright,)
    corners = np.array(shape.minimum_rotated_rectangle.exterior.coords)
    return upright, np.sort(np.linalg.norm(np.diff(corners[:3], axis=0), axis=1))

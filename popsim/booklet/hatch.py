"""Hatching: parallel lines within an area."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


def hatched(area: "BaseGeometry", pitch: float, angle: float) -> "BaseGeometry":
    """Lines `pitch` mm apart at `angle` (rad, from x) within `area`; the same wherever the area ends."""
    import shapely

    if area.is_empty:
        return shapely.MultiLineString()
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    corners = shapely.get_coordinates(area)
    low, high = (corners @ across).min(), (corners @ across).max()
    start, end = (corners @ along).min() - pitch, (corners @ along).max() + pitch
    levels = np.arange(np.ceil(low / pitch), np.floor(high / pitch) + 1) * pitch
    lines = np.stack([np.outer(levels, across) + start * along, np.outer(levels, across) + end * along], axis=1)
    if len(lines) == 0:
        return shapely.MultiLineString()
    return shapely.intersection(shapely.multilinestrings(list(lines)), area)

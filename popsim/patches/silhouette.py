"""From masks to polygons."""

from typing import TYPE_CHECKING, Any

import numpy as np

from popsim.geometry.arrays import BoolArray
from popsim.patches.clean import union, without
from popsim.patches.sight import Grid

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

STAIRS = 0.6
"""Pixels; contours of masks go in stairs of half a pixel, and this makes them straight again."""

SPECK = 16.0
"""Pixels; islands and holes of fewer are noise."""


def mask_polygon(mask: BoolArray, grid: Grid) -> "BaseGeometry":
    """Polygon or polygons around the true pixels of a mask, in the flat coordinates of the grid."""
    from shapely.geometry import Polygon
    from skimage.measure import find_contours

    padded = np.pad(mask, 1).astype(np.float32)
    outer: list[Any] = []
    holes: list[Any] = []
    contours: list[Any] = find_contours(padded, 0.5)  # type: ignore[no-untyped-call]  # skimage is half typed
    for contour in contours:
        turned = _turned(contour)
        if abs(turned) >= SPECK and len(contour) > 3:
            (outer if turned > 0 else holes).append(Polygon(grid.flat(contour - 1)))
    return _joined(outer, holes).simplify(STAIRS * grid.pixel)


def _turned(contour: Any) -> float:
    """Area of a contour in pixels, negative around holes."""
    row, column = contour[:-1, 0], contour[:-1, 1]
    return -float(row @ np.roll(column, -1) - column @ np.roll(row, -1)) / 2


def _joined(outer: list[Any], holes: list[Any]) -> "BaseGeometry":
    return without(union(*(ring.buffer(0) for ring in outer)), union(*(ring.buffer(0) for ring in holes)))

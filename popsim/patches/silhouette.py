"""From masks to polygons."""

from typing import TYPE_CHECKING, Any

import numpy as np

from popsim.geometry.arrays import BoolArray
from popsim.patches.clean import union, without
from popsim.patches.sight import Grid

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

BLUR = 0.5
"""Pixels; masks are softened by this, so that slanted contours do not go in stairs. Straight edges stay."""

PAD = 2
"""Pixels of nothing around a mask: as far as softness reaches."""

STAIRS = 0.8
"""Pixels; what is left of stairs, and made straight."""

SPECK = 16.0
"""Pixels; islands and holes of fewer are noise."""


def mask_polygon(mask: BoolArray, grid: Grid) -> "BaseGeometry":
    """Polygon or polygons around the true pixels of a mask, in the flat coordinates of the grid."""
    from scipy.ndimage import gaussian_filter
    from shapely.geometry import Polygon
    from skimage.measure import find_contours

    padded = gaussian_filter(np.pad(mask, PAD).astype(np.float32), BLUR, mode="constant")
    outer: list[Any] = []
    holes: list[Any] = []
    contours: list[Any] = find_contours(padded, 0.5)  # type: ignore[no-untyped-call]  # skimage is half typed
    for contour in contours:
        turned = _turned(contour)
        if abs(turned) >= SPECK and len(contour) > 3:
            (outer if turned > 0 else holes).append(Polygon(grid.flat(contour - PAD)))
    return _joined(outer, holes).simplify(STAIRS * grid.pixel)


def _turned(contour: Any) -> float:
    """Area of a contour in pixels, negative around holes."""
    row, column = contour[:-1, 0], contour[:-1, 1]
    return -float(row @ np.roll(column, -1) - column @ np.roll(row, -1)) / 2


def _joined(outer: list[Any], holes: list[Any]) -> "BaseGeometry":
    return without(union(*(ring.buffer(0) for ring in outer)), union(*(ring.buffer(0) for ring in holes)))

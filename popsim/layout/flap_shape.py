"""The shape of one flap: a trapezoid, trimmed to where paper may go."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.flat import common, without

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

INSET = 0.5
"""mm; how far the ends of a flap stay clear of the ends of its edge."""

APART = 0.3
"""mm; a flap keeps this distance from other paper of its own piece, so that scissors can go between."""

SLIVER = 0.4
"""mm; spikes narrower than twice this are cut away: nobody can cut or glue them."""

BLUNT = 0.45
"""Depth of a flap over its edge at most: just short of a half, so that it keeps a blunt end."""

ROUNDING = 0.01
"""mm; corners this close to a line are taken for points of it."""

SHORTEST_HOLD = 0.5
"""mm; a flap that hangs on less tears off."""

SHORTEST_TAB = 2.5
"""mm; depth of a flap on an edge that is too short for 45 degree sides."""


def trapezoid(length: float, depth: float) -> "Polygon":
    """Flap over an edge of `length`, 45 degree sides, in strip coordinates (along the edge, away from it).

    Its depth is at most half the edge; its ends stay clear of the corners.
    """
    from shapely.geometry import Polygon

    inset = min(INSET, length / 10)
    depth = min(depth, BLUNT * (length - 2 * inset))
    rise = [(inset, 0.0), (length - inset, 0.0), (length - inset - depth, depth), (inset + depth, depth)]
    return Polygon(rise)


def tab(length: float, depth: float) -> "Polygon":
    """Straight flap over all of an edge too short for a trapezoid that could be glued."""
    from shapely.geometry import box

    return box(length / 20, 0.0, length * 19 / 20, min(depth, SHORTEST_TAB))


def trimmed(flap: "Polygon", blocked: "BaseGeometry", allowed: "BaseGeometry") -> "Polygon | None":
    """What of `flap` (strip coordinates) lies in `allowed` and off `blocked`, in one piece along its edge."""
    import shapely

    sliver = min(SLIVER, flap.bounds[3] / 5)
    rest = without(common(flap, allowed), blocked)
    rest = common(rest.buffer(-sliver, join_style="mitre").buffer(sliver, join_style="mitre"), rest)
    shapes = [_on_edge(piece) for piece in shapely.get_parts(rest) if piece.geom_type == "Polygon"]
    useful = [shape for shape in shapes if shape is not None and hold(shape) >= SHORTEST_HOLD]
    return max(useful, key=lambda shape: shape.area, default=None)


def _on_edge(piece: "Polygon") -> "Polygon | None":
    """`piece` without holes and needless corners, its corners near the edge put onto it."""
    import shapely

    corners = shapely.get_coordinates(piece.exterior.simplify(ROUNDING))
    corners[np.abs(corners[:, 1]) < 3 * ROUNDING, 1] = 0.0
    shape = shapely.Polygon(corners)
    return shapely.orient_polygons(shape) if shape.is_valid and shape.area > 0 else None


def hold(flap: "Polygon") -> float:
    """Length over which a flap hangs on its edge, mm."""
    low, high = crease_span(flap)
    return high - low


def crease_span(flap: "Polygon") -> tuple[float, float]:
    """Ends of the crease of a flap, mm along its edge."""
    on_line = [x for x, y in flap.exterior.coords if y == 0.0]
    return (min(on_line), max(on_line)) if on_line else (0.0, 0.0)

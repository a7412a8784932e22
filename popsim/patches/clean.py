"""Outlines that scissors can follow: nothing thinner than they cut, straight where it may be.

Shapes are areas: any number of polygons, possibly none. Overlays are taken on a grid, on which they cannot fail.
"""

from typing import TYPE_CHECKING

import numpy as np

from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

SIMPLIFY = 0.6
"""Share of the tolerance left to simplification; pixels and cleaning take the rest."""

GRAIN = 1e-6
"""mm; coordinates of outlines are rounded to this."""

STRAIGHT = 1e-3
"""mm; a corner that is off the line between its neighbours by less is none."""

LONG = 3.0
"""What is too thin to cut counts where it is so many times longer than the least width;"""

SLIM = 0.7
"""and it may be this much thinner in places than on average."""

ROUND = 3
"""Corners to a quarter of a circle, round bends of what is widened: mitres would stick out of it."""

ROUNDING = 0.02
"""mm; paper narrower than this is a rounding error."""


def union(*shapes: "BaseGeometry") -> "BaseGeometry":
    """What lies in any of the shapes."""
    from shapely import union_all

    return area(union_all([area(shape) for shape in shapes], grid_size=GRAIN))


def common(first: "BaseGeometry", second: "BaseGeometry") -> "BaseGeometry":
    """What lies in both shapes."""
    from shapely import intersection

    return area(intersection(area(first), area(second), grid_size=GRAIN))


def without(first: "BaseGeometry", second: "BaseGeometry") -> "BaseGeometry":
    """What lies in the first shape only."""
    from shapely import difference

    return area(difference(area(first), area(second), grid_size=GRAIN))


def area(shape: "BaseGeometry") -> "BaseGeometry":
    """The polygons of any geometry, without its lines and points; mended where offsets made them cross."""
    from shapely import get_parts, make_valid
    from shapely.geometry import MultiPolygon

    if shape.geom_type in ("Polygon", "MultiPolygon"):
        return shape if shape.is_valid else area(make_valid(shape))
    return MultiPolygon([part for part in get_parts(shape) if part.geom_type == "Polygon"])


def opened(shape: "BaseGeometry", width: float) -> "BaseGeometry":
    """`shape` without its parts narrower than `width`."""
    half = width / 2
    return common(_offset(_offset(shape, -half), half), shape)


def closed(shape: "BaseGeometry", width: float) -> "BaseGeometry":
    """`shape` with slits and holes narrower than `width` filled."""
    half = width / 2
    return union(_offset(_offset(shape, half), -half), shape)


def cuttable(wanted: "BaseGeometry", room: "Polygon", settings: PatchSettings) -> "BaseGeometry":
    """A silhouette as paper can be cut: no slit, hole or strip thinner than the settings allow.

    Masts, poles and bars that are thinner are made as wide as that.
    """
    least = settings.thinnest
    filled = common(closed(wanted, least), room)
    solid = opened(filled, least)
    bars = [_widened(bar, least) for bar in polygons(without(filled, solid)) if bar.length / 2 >= LONG * least]
    if not bars:
        return solid
    return opened(common(closed(union(solid, *bars), least), room), least)


def _widened(bar: "Polygon", least: float) -> "Polygon":
    """A bar that is too thin, all of it at least that wide, but no longer: spikes beyond its ends go."""
    import shapely

    width = SLIM * 2 * bar.area / bar.length
    by = max(least - width, 0.0) / 2
    frame = shapely.minimum_rotated_rectangle(bar)
    (a, b, c, _, _) = shapely.get_coordinates(frame)
    across = (b - a if np.linalg.norm(b - a) < np.linalg.norm(c - b) else c - b) if by else np.zeros(2)
    aside = across * by / max(float(np.linalg.norm(across)), ROUNDING)
    corners = np.concatenate([shapely.get_coordinates(frame) + sign * aside for sign in (1, -1)])
    return common(bar.buffer(by, quad_segs=ROUND), shapely.MultiPoint(corners).convex_hull)


def straightened(shape: "BaseGeometry", face: "Polygon", settings: PatchSettings) -> "BaseGeometry":
    """`shape` ending exactly at the edges of its face wherever it all but does.

    What reaches less than `snap` beyond them goes, and what is missing along them by less than the tolerance to
    either side is filled.
    """
    missing = opened(without(face, shape), 2 * settings.tolerance)
    return opened(union(without(face, missing), opened(without(shape, face), settings.snap)), ROUNDING)


def simplified(shape: "BaseGeometry", settings: PatchSettings) -> "BaseGeometry":
    """`shape` with fewer vertices, within the tolerance."""
    return shape.simplify(SIMPLIFY * settings.tolerance)


def tidy(outline: "Polygon") -> "Polygon":
    """`outline` counterclockwise, without corners that are none."""
    from shapely.geometry.polygon import orient

    plain = polygons(outline.simplify(STRAIGHT).buffer(0))
    return orient(plain[0] if plain else outline)


def polygons(shape: "BaseGeometry") -> list["Polygon"]:
    """The polygons of a shape, the largest first; rounding errors are left out."""
    from shapely import get_parts

    parts = [part for part in get_parts(area(shape)) if not part.buffer(-ROUNDING / 2).is_empty]
    return sorted(parts, key=lambda part: -part.area)


def _offset(shape: "BaseGeometry", by: float) -> "BaseGeometry":
    with np.errstate(divide="ignore", invalid="ignore"):  # GEOS divides by zero at spikes, and copes
        return shape.buffer(by, join_style="mitre", mitre_limit=3.0)

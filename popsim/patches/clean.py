"""Outlines that scissors can follow: nothing thinner than they cut, straight where it may be."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

SIMPLIFY = 0.6
"""Share of the tolerance left to simplification; pixels and cleaning take the rest."""

GRAIN = 1e-6
"""mm; coordinates of outlines are rounded to this, so that unions leave no splinters."""

ROUNDING = 0.02
"""mm; paper narrower than this is a rounding error."""


def opened(shape: "BaseGeometry", width: float) -> "BaseGeometry":
    """`shape` without its parts narrower than `width`."""
    half = width / 2
    return _offset(_offset(shape, -half), half).intersection(shape)


def closed(shape: "BaseGeometry", width: float) -> "BaseGeometry":
    """`shape` with slits and holes narrower than `width` filled."""
    half = width / 2
    return _offset(_offset(shape, half), -half).union(shape)


def cuttable(wanted: "BaseGeometry", room: "Polygon", settings: PatchSettings) -> "BaseGeometry":
    """A silhouette as paper can be cut: no slit, hole or strip thinner than the settings allow."""
    filled = closed(wanted, settings.thinnest).intersection(room)
    return opened(filled, settings.thinnest)


def straightened(shape: "BaseGeometry", face: "Polygon", snap: float) -> "BaseGeometry":
    """`shape` ending exactly at the edges of its face wherever it reaches less than `snap` beyond them."""
    beyond = opened(shape.difference(face), snap)
    return shape.intersection(face).union(beyond.buffer(GRAIN)).intersection(shape)


def simplified(shape: "BaseGeometry", settings: PatchSettings) -> "BaseGeometry":
    """`shape` with fewer vertices, within the tolerance."""
    return shape.simplify(SIMPLIFY * settings.tolerance)


def polygons(shape: "BaseGeometry") -> list["Polygon"]:
    """The polygons of any geometry, the largest first; rounding errors are left out."""
    from shapely import get_parts

    parts = [part for part in get_parts(shape) if part.geom_type == "Polygon"]
    return sorted((p for p in parts if not p.buffer(-ROUNDING / 2).is_empty), key=lambda p: -p.area)


def _offset(shape: "BaseGeometry", by: float) -> "BaseGeometry":
    with np.errstate(divide="ignore", invalid="ignore"):  # GEOS divides by zero at spikes, and copes
        return shape.buffer(by, join_style="mitre", mitre_limit=3.0)

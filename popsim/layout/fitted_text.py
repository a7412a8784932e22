"""A line of text that stays inside a shape."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import Role, Text, text_width

if TYPE_CHECKING:
    from shapely.geometry import Polygon

SHRINKING = (1.0, 0.85, 0.7, 0.55, 0.4)
"""Sizes tried, of the wished one; the last is taken even where it does not fit."""

RISE = 0.73
"""Height of capitals and figures of the font, of its size."""


def fitted_text(text: str, shape: "Polygon", size: float) -> Text:
    """A label in `shape`: in its middle or its widest spot, along its longest edge or level, shrunk to fit."""
    from shapely import Point, maximum_inscribed_circle

    widest = np.array(maximum_inscribed_circle(shape, tolerance=0.1).coords[0])
    middle = np.array(shape.centroid.coords[0])
    spots = [middle, widest] if shape.contains(Point(middle)) else [widest]
    angles = [_upright(_longest_edge(shape)), 0.0, np.pi / 2]
    for share in SHRINKING:
        for spot in spots:
            for angle in angles:
                if shape.contains(_box(text, spot, share * size, angle)):
                    return _centred(text, spot, share * size, angle)
    return _centred(text, widest, SHRINKING[-1] * size, angles[0])


def _longest_edge(shape: "Polygon") -> float:
    edges = np.diff(np.array(shape.exterior.coords), axis=0)
    along = edges[int(np.linalg.norm(edges, axis=1).round(3).argmax())]
    return float(np.arctan2(along[1], along[0]))


def _upright(angle: float) -> float:
    """The angle, or half a turn more, that reads from left to right or upward."""
    angle = (angle + np.pi) % (2 * np.pi) - np.pi
    return angle if -np.pi / 2 + 1e-6 < angle <= np.pi / 2 + 1e-6 else angle + (np.pi if angle < 0 else -np.pi)


def _box(text: str, centre: FloatArray, size: float, angle: float) -> "Polygon":
    from shapely.geometry import Polygon

    half = np.array([text_width(text, size), RISE * size * 1.2]) / 2
    along = np.array([np.cos(angle), np.sin(angle)]) * half[0]
    across = np.array([-np.sin(angle), np.cos(angle)]) * half[1]
    return Polygon(
        [centre - along - across, centre + along - across, centre + along + across, centre - along + across]
    )


def _centred(text: str, centre: FloatArray, size: float, angle: float) -> Text:
    down = RISE / 2 * size * np.array([np.sin(angle), -np.cos(angle)])
    return Text(Role.LABEL, text, centre + down, size, angle, "middle")

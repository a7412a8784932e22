"""Lines of text inside shapes, and off each other."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import Role, Text, text_width

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

SHRINKING = (1.0, 0.85, 0.7, 0.55)
"""Sizes tried, of the wished one."""

LEGIBLE = 1.4
"""mm, four points; smaller text is not tried."""

RISE = 0.73
"""Height of capitals and figures of the font, of its size."""

ALONG = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Places tried along the longest edge of a shape, of its length."""

DISTANCES = (1.5, 2.5, 3.5, 5.0, 7.0, 9.0)
"""mm from a shape that is too small for its text to places tried beside it."""

DIRECTIONS = 12
"""Directions tried at each distance."""


@dataclass
class Lettering:
    """Texts on one piece, placed one after the other.

    Attributes
    ----------
    paper:
        The piece as cut: texts that do not fit where they belong stay on it, beside their place.
    printed:
        Where it bears pictures: texts there get a rim of white.
    """

    paper: "Polygon"
    printed: "BaseGeometry"
    _taken: list["Polygon"] = field(default_factory=list)

    def put(self, text: str, shape: "Polygon", size: float) -> Text:
        """A label in `shape`, along its longest edge or level, shrunk to fit; beside it if it is too small."""
        spot, share, angle = self._free(text, shape, size)
        box = _box(text, spot, share, angle)
        self._taken.append(box)
        down = RISE / 2 * share * np.array([np.sin(angle), -np.cos(angle)])
        halo = bool(self.printed.intersects(box))
        return Text(Role.LABEL, text, spot + down, share, angle, "middle", halo=halo)

    def fits(self, text: str, shape: "Polygon", size: float) -> bool:
        """Whether `text` goes into `shape` as large as that."""
        angles = _angles(shape)
        return any(shape.contains(_box(text, spot, size, angle)) for spot in _spots(shape) for angle in angles)

    def _free(self, text: str, shape: "Polygon", size: float) -> tuple[FloatArray, float, float]:
        """Middle (2,), size and angle of the best place that nothing else takes."""
        spots, angles = list(_spots(shape)), _angles(shape)
        for tried in _sizes(size):
            for spot in spots:
                for angle in angles:
                    if self._is_free(_box(text, spot, tried, angle), shape):
                        return spot, tried, angle
        smallest = min(size, LEGIBLE)
        for spot in _around(spots[-1]):
            for angle in angles:
                if self._is_free(_box(text, spot, smallest, angle), self.paper):
                    return spot, smallest, angle
        return spots[-1], smallest, angles[0]

    def _is_free(self, box: "Polygon", shape: "Polygon") -> bool:
        return bool(shape.contains(box)) and not any(box.intersects(taken) for taken in self._taken)


def _sizes(size: float) -> list[float]:
    return sorted({max(share * size, min(size, LEGIBLE)) for share in SHRINKING}, reverse=True)


def _spots(shape: "Polygon") -> Iterator[FloatArray]:
    """Places in a shape: its middle, places along its longest edge, its widest spot."""
    from shapely import Point, maximum_inscribed_circle

    widest = np.array(maximum_inscribed_circle(shape, tolerance=0.1).coords[0])
    middle = np.array(shape.centroid.coords[0])
    if shape.contains(Point(middle)):
        yield middle
    yield widest
    edge = _longest_edge(shape)
    along = edge[1] - edge[0]
    start = widest - along * float((widest - edge[0]) @ along) / float(along @ along)
    for share in ALONG:
        yield start + share * along
    yield widest


def _around(spot: FloatArray) -> Iterator[FloatArray]:
    """Places about a spot, the nearest first."""
    turns = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    for distance in DISTANCES:
        yield from spot + distance * np.stack([np.cos(turns), np.sin(turns)], axis=1)


def _angles(shape: "Polygon") -> list[float]:
    along = np.diff(_longest_edge(shape), axis=0)[0]
    return [_upright(float(np.arctan2(along[1], along[0]))), 0.0, np.pi / 2]


def _longest_edge(shape: "Polygon") -> FloatArray:
    """Ends of the longest edge, shape (2, 2)."""
    corners = np.array(shape.exterior.coords)
    longest = int(np.linalg.norm(np.diff(corners, axis=0), axis=1).round(3).argmax())
    return corners[longest : longest + 2]


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

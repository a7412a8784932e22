"""Lines of text inside shapes, and off each other."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import Role, Text, text_width

if TYPE_CHECKING:
    import numpy.typing as npt
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
        spot, share, angle, box = self._free(text, shape, size)
        self._taken.append(box)
        down = RISE / 2 * share * np.array([np.sin(angle), -np.cos(angle)])
        halo = bool(self.printed.intersects(box))
        return Text(Role.LABEL, text, spot + down, share, angle, "middle", halo=halo)

    def fits(self, text: str, shape: "Polygon", size: float) -> bool:
        """Whether `text` goes into `shape` as large as that."""
        import shapely

        return bool(shapely.contains(shape, _boxes(text, *_places(_spots(shape), _angles(shape)), size)).any())

    def _free(self, text: str, shape: "Polygon", size: float) -> "tuple[FloatArray, float, float, Polygon]":
        """Middle (2,), size, angle and surroundings of the best place that nothing else takes."""
        import shapely

        shapely.prepare([shape, self.paper])
        spots, angles = _spots(shape), _angles(shape)
        smallest = min(size, LEGIBLE)
        inside = [(spots, tried, shape) for tried in _sizes(size)]
        for middles, tried, paper in (*inside, (_around(spots[-1]), smallest, self.paper)):
            centres, turns = _places(middles, angles)
            boxes = _boxes(text, centres, turns, tried)
            for k in np.flatnonzero(shapely.contains(paper, boxes)):
                if not shapely.intersects(boxes[k], self._taken).any():
                    return centres[k], tried, float(turns[k]), boxes[k]
        (box,) = _boxes(text, spots[-1:], np.array(angles[:1]), smallest)
        return spots[-1], smallest, angles[0], box


def _sizes(size: float) -> list[float]:
    return sorted({max(share * size, min(size, LEGIBLE)) for share in SHRINKING}, reverse=True)


def _spots(shape: "Polygon") -> FloatArray:
    """Places in a shape: its middle, places along its longest edge, its widest spot, shape (n, 2)."""
    from shapely import Point, maximum_inscribed_circle

    widest = np.array(maximum_inscribed_circle(shape, tolerance=0.1).coords[0])
    middle = np.array(shape.centroid.coords[0])
    edge = _longest_edge(shape)
    along = edge[1] - edge[0]
    start = widest - along * float((widest - edge[0]) @ along) / float(along @ along)
    lined_up = start + np.array(ALONG)[:, None] * along
    return np.array([*([middle] if shape.contains(Point(middle)) else []), widest, *lined_up, widest])


def _around(spot: FloatArray) -> FloatArray:
    """Places about a spot, the nearest first, shape (n, 2)."""
    turns = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    ring = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    return np.asarray(spot + (np.array(DISTANCES)[:, None, None] * ring).reshape(-1, 2))


def _places(spots: FloatArray, angles: list[float]) -> tuple[FloatArray, FloatArray]:
    """Each spot (n, 2) at each angle: spots (k, 2) and angles (k,)."""
    return np.repeat(spots, len(angles), axis=0), np.tile(angles, len(spots))


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


def _boxes(text: str, centres: FloatArray, angles: FloatArray, size: float) -> "npt.NDArray[np.object_]":
    """What a text takes about each centre (k, 2) at each angle (k,): polygons, shape (k,)."""
    import shapely

    half = np.array([text_width(text, size), RISE * size * 1.2]) / 2
    cosine, sine = np.cos(angles), np.sin(angles)
    along, across = np.stack([cosine, sine], axis=1) * half[0], np.stack([-sine, cosine], axis=1) * half[1]
    corners = np.stack([-along - across, along - across, along + across, across - along], axis=1)
    return np.asarray(shapely.polygons(centres[:, None] + corners))

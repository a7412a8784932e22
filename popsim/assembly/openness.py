"""How open each part lies in the finished pop-up: what cannot be seen from outside cannot be reached either."""

from collections.abc import Mapping

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.layout.parts import Part

LIFT = 0.2
"""mm; rays start this far off the paper."""

HIDDEN = 0.05
"""A part from which fewer rays than this share escape on either side is shut in."""

RAYS = 64
"""Directions tried from each spot."""


def openness(parts: Mapping[str, Part]) -> dict[str, float]:
    """Share of directions from which each part can be seen in the open pose, on its better side, by part id."""
    return {name: _openness(part, parts) for name, part in parts.items()}


def _openness(part: Part, parts: Mapping[str, Part]) -> float:
    spot = part.polygon.representative_point()
    centre = part.plane.lift(np.array([spot.x, spot.y]))
    best = 0.0
    for side in (1, -1):
        normal = side * part.plane.normal
        directions = _directions()
        directions = directions[directions @ normal > 0.1]
        start = centre + LIFT * normal
        free = np.ones(len(directions), dtype=bool)
        for other in parts.values():
            free[free] = ~_hit(start, directions[free], other)
        best = max(best, float(free.mean()))
    return best


def _directions() -> FloatArray:
    """Directions spread evenly over the sphere (Fibonacci), shape (RAYS, 3)."""
    k = np.arange(RAYS) + 0.5
    z = 1 - 2 * k / RAYS
    turn = np.pi * (1 + np.sqrt(5)) * k
    rim = np.sqrt(1 - z**2)
    return np.stack([rim * np.cos(turn), rim * np.sin(turn), z], axis=1)


def _hit(start: FloatArray, directions: FloatArray, part: Part) -> BoolArray:
    """Whether rays from `start` meet `part`, shape (n,)."""
    import shapely

    slope = directions @ part.plane.normal
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = -float(part.plane.distance(start)) / slope
    reached = np.isfinite(distance) & (distance > 1e-9)
    spots = part.flat(start + np.where(reached, distance, 0.0)[:, None] * directions)
    return np.asarray(reached & shapely.contains_xy(part.polygon, spots[:, 0], spots[:, 1]))

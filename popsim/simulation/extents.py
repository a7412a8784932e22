"""Where the real outlines are in the recorded poses: flat, within the page, back in place."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.forest import PAGES
from popsim.simulation.sweep import Sweep

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


@dataclass(frozen=True)
class Farthest:
    """A length and the patch it was found at."""

    value: float
    patch: str


def flatness(sweep: Sweep) -> Farthest:
    """Greatest distance of any corner from the plane of the closed card (y = 0), mm."""
    return _farthest(sweep, lambda patch: float(np.abs(_at(sweep, patch, sweep.closed)[:, 1]).max()))


def reopening(sweep: Sweep) -> Farthest:
    """Greatest distance of any corner from where it was before closing and opening, mm."""

    def moved(patch: str) -> float:
        first, last = (_at(sweep, patch, position) for position in (0, -1))
        return float(np.linalg.norm(last - first, axis=-1).max())

    return _farthest(sweep, moved)


def protrusion(sweep: Sweep) -> Farthest:
    """How far the closed pop-up sticks out of what both closed pages cover, mm; 0: nothing does."""
    from shapely.geometry import Point

    first, second = (_silhouette(sweep, name) for name in PAGES)
    cover = first.intersection(second)

    def beyond(patch: str) -> float:
        outside = _silhouette(sweep, patch).difference(cover)
        parts = [part for part in getattr(outside, "geoms", [outside]) if part.area > 0]
        corners = [Point(corner) for part in parts for corner in part.exterior.coords]
        return max((float(cover.distance(corner)) for corner in corners), default=0.0)

    return _farthest(sweep, beyond)


def sweep_range(sweep: Sweep, patches: tuple[str, ...]) -> tuple[float, float]:
    """Least and greatest x that any of `patches` reaches, mm."""
    xs = [sweep.moved(name)[..., 0] for name in patches]
    return min(float(x.min()) for x in xs), max(float(x.max()) for x in xs)


def _farthest(sweep: Sweep, measure: Callable[[str], float]) -> Farthest:
    """The patch of the pop-up with the greatest measure; an empty card has none."""
    found = [Farthest(measure(patch.id), patch.id) for patch in sweep.design.popup_patches]
    return max(found, key=lambda farthest: farthest.value, default=Farthest(0.0, ""))


def _silhouette(sweep: Sweep, patch: str) -> "BaseGeometry":
    """Outline of a patch in the plane of the closed card, as (x, z)."""
    from shapely import make_valid
    from shapely.geometry import Polygon

    outline = transform(sweep.poses[sweep.closed, sweep.index[patch]], sweep.design.patch_by_id[patch].points)
    return make_valid(Polygon(outline[:, [0, 2]]))


def _at(sweep: Sweep, patch: str, position: int) -> FloatArray:
    """Hull corners of a patch at one recorded angle, shape (k, 3)."""
    place = sweep.index[patch]
    return transform(sweep.poses[position, place], sweep.hulls[place])

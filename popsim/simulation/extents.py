"""Where the real outlines are in the recorded poses: flat, within the page, back in place."""

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
    return _farthest(sweep, np.abs(sweep.places[sweep.closed, :, 1]))


def reopening(sweep: Sweep) -> Farthest:
    """Greatest distance of any corner from where it was before closing and opening, mm."""
    return _farthest(sweep, np.linalg.norm(sweep.places[-1] - sweep.places[0], axis=-1))


def protrusion(sweep: Sweep) -> Farthest:
    """How far the closed pop-up sticks out of what both closed pages cover, mm; 0: nothing does."""
    from shapely import covers

    silhouettes = {patch.id: _silhouette(sweep, patch.id) for patch in sweep.design.patches}
    first, second = (silhouettes.pop(page) for page in PAGES)
    cover = first.intersection(second)
    inside = covers(cover, list(silhouettes.values()))
    found = [
        Farthest(0.0 if within else _beyond(cover, shape), name)
        for (name, shape), within in zip(silhouettes.items(), inside, strict=True)
    ]
    return max(found, key=lambda farthest: farthest.value, default=Farthest(0.0, ""))


def sweep_range(sweep: Sweep, patches: tuple[str, ...]) -> tuple[float, float]:
    """Least and greatest x that any of `patches` reaches, mm."""
    xs = [sweep.moved(name)[..., 0] for name in patches]
    return min(float(x.min()) for x in xs), max(float(x.max()) for x in xs)


def _farthest(sweep: Sweep, lengths: FloatArray) -> Farthest:
    """The patch of the pop-up with the greatest of lengths (v,) at hull corners; an empty card has none."""
    greatest = sweep.corners.greatest(lengths[None])[0]
    found = [Farthest(float(greatest[sweep.index[patch.id]]), patch.id) for patch in sweep.design.popup_patches]
    return max(found, key=lambda farthest: farthest.value, default=Farthest(0.0, ""))


def _beyond(cover: "BaseGeometry", shape: "BaseGeometry") -> float:
    """How far a silhouette reaches out of what the pages cover, mm."""
    from shapely.geometry import Point

    outside = shape.difference(cover)
    parts = [part for part in getattr(outside, "geoms", [outside]) if part.area > 0]
    corners = [Point(corner) for part in parts for corner in part.exterior.coords]
    return max((float(cover.distance(corner)) for corner in corners), default=0.0)


def _silhouette(sweep: Sweep, patch: str) -> "BaseGeometry":
    """Outline of a patch in the plane of the closed card, as (x, z)."""
    from shapely import make_valid
    from shapely.geometry import Polygon

    outline = transform(sweep.poses[sweep.closed, sweep.index[patch]], sweep.design.patch_by_id[patch].points)
    return make_valid(Polygon(outline[:, [0, 2]]))

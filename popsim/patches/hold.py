"""Hinges need paper on both sides: where a silhouette misses its hinge line, strips of the face reach for it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.patches.clean import common, union
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

STEP = 0.5
"""mm between the places along a line where the distance to the silhouette is taken."""

OVERLAP = 0.75
"""mm by which a strip reaches into the silhouette, so that both are one."""

BAND = 1.5
"""mm of paper to each side of a line on which another mechanism stands."""

WITHIN = 0.3
"""mm; paper that holds something inside its outline reaches at least this far around the line."""

LEVEL = 0.5
"""mm; outlines whose distances from a line differ by less are equally near."""

ROUNDING = 1e-6
"""mm."""

RISEN = 1.0
"""mm beyond a line at which a fin is looked for, and beside it that its slit may take."""

UNDER = 5.0
"""mm; what paper that is missing under a foot counts: less than a far silhouette, more than a near one."""


@dataclass(frozen=True, eq=False)
class Run:
    """The line of a joint in the flat coordinates of one piece.

    Attributes
    ----------
    piece:
        The piece.
    ends:
        Ends of the axis, shape (2, 2).
    inward:
        Unit normal of the line to the side of the face; None where the face lies on both sides.
    """

    piece: Piece
    ends: FloatArray
    inward: FloatArray | None

    @staticmethod
    def of(piece: Piece, axis: FloatArray) -> "Run":
        """The line of a joint with this axis (2, 3) on a piece."""
        from shapely import contains_xy

        ends = piece.plane.flat(axis)
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        normal = np.array([-along[1], along[0]])
        places = ends[0] + (ends[1] - ends[0]) * np.linspace(0.1, 0.9, 9)[:, None]
        sides = [float(contains_xy(piece.face, *(places + sign * WITHIN * normal).T).mean()) for sign in (1, -1)]
        if min(sides) > 0.5:
            return Run(piece, ends, None)
        return Run(piece, ends, normal if sides[0] >= sides[1] else -normal)

    @property
    def length(self) -> float:
        """Length of the axis, mm."""
        return float(np.linalg.norm(self.ends[1] - self.ends[0]))

    def places(self, along: FloatArray) -> FloatArray:
        """Points of the line, shape (n, 2)."""
        return np.asarray(self.ends[0] + (self.ends[1] - self.ends[0]) * (along / self.length)[:, None])

    def distances(self, along: FloatArray) -> FloatArray:
        """How far the outline is from the line, inward, at each place; the size of the face if there is none."""
        import shapely

        places = self.places(along)
        left, lower, right, upper = self.piece.face.bounds
        size = float(np.hypot(right - left, upper - lower))
        if self.piece.shape.is_empty:
            return np.full(len(along), size if self.inward is not None else UNDER)
        if self.inward is None:
            inner = self.piece.shape.buffer(-WITHIN)
            return np.where(shapely.contains_xy(inner, *places.T), 0.0, UNDER)
        deep = places + self.inward * size
        rays = shapely.linestrings(np.stack([places - self.inward * WITHIN, deep], axis=1))
        found = shapely.distance(shapely.points(places), shapely.intersection(rays, self.piece.shape))
        return np.where(np.isnan(found), size, np.where(found <= WITHIN, 0.0, found))

    def strip(self, low: float, high: float, along: FloatArray, depth: FloatArray) -> "BaseGeometry":
        """Paper of some depth at each place, inward from the line between two of its points, within the face."""
        from shapely.geometry import LineString, Polygon

        start, end = self.places(np.array([low, high]))
        if self.inward is None:
            return common(LineString([start, end]).buffer(BAND, cap_style="flat"), self.piece.face)
        heights = np.interp([low, *along, high], along, depth + OVERLAP)
        far = self.places(np.array([low, *along, high])) + self.inward * heights[:, None]
        return common(Polygon([start, *far, end]).buffer(0), self.piece.face)


def hold(runs: list[Run], settings: PatchSettings, snap: float | None = None, mates: Sequence[Run] = ()) -> bool:
    """Give the pieces at a joint paper along its line where they hold; return whether strips had to be added.

    The outline goes to the line where it comes nearer than `snap` (None: that of the settings); if that is too
    little of the line, ever farther stretches of it are joined to the line, the nearest ones first. Where a fin
    passes the line there will be a slit: the hinge is held beside it, as far as there is room. The fin may be one
    of the pieces, or of the `mates`, which are hinged to one of them on the same line.
    """
    snap = settings.snap if snap is None else snap
    length = runs[0].length
    count = max(4, int(np.ceil(length / STEP)))
    along = np.asarray((np.arange(count) + 0.5) * (length / count), np.float64)
    each = [run.distances(along) for run in runs]
    cost = np.max(each, axis=0)
    free = ~_pierced(runs, mates, along)
    beside = free.sum() * length / count >= settings.least_hold(length)
    near = _near(np.where(free, cost, np.inf) if beside else cost, along, length, snap, settings)
    stretches = _stretches(near, along, length, settings)
    for run, distance in zip(runs, each, strict=True):
        for low, high in stretches:
            within = (along > low) & (along < high)
            strip = run.strip(low, high, along[within], np.minimum(distance[within], cost[near].max()))
            run.piece.shape = union(run.piece.shape, strip)
            run.piece.held.append(strip)
    return bool(cost[near].max() > snap)


def _pierced(runs: Sequence[Run], mates: Sequence[Run], along: FloatArray) -> BoolArray:
    """Places at which a patch inside goes on beyond the line where one that is seen ends, which will be slit."""
    import shapely

    found = np.zeros(len(along), dtype=bool)
    if not any(run.piece.plate.principal for run in runs):
        return found
    for run in (*runs, *mates):
        if not run.piece.plate.principal and run.inward is not None:
            above = run.places(along) - RISEN * run.inward
            found |= shapely.contains_xy(run.piece.shape.buffer(RISEN), *above.T)
    return found


def _near(cost: FloatArray, along: FloatArray, length: float, snap: float, settings: PatchSettings) -> BoolArray:
    """Places at which the outline is joined to the line: those within snap, and of the rest as few as hold.

    The rest are taken nearest to the line first; of those equally near, the ones beside places taken already.
    """
    needed = settings.least_hold(length) - ROUNDING
    near = cost <= snap
    seeds = along[near] if near.any() else along[cost.argmin()][None]
    aside = np.abs(along[:, None] - seeds[None, :]).min(axis=1)
    order = np.lexsort((aside, np.ceil(cost / LEVEL)))
    for place in order[~near[order]]:
        if sum(high - low for low, high in _stretches(near, along, length, settings)) >= needed:
            break
        near[place] = True
    return np.asarray(near)


def _stretches(
    near: BoolArray, along: FloatArray, length: float, settings: PatchSettings
) -> list[tuple[float, float]]:
    """Ends of the runs of places that are near, long enough to hold; ends near those of the line go to them."""
    half = float(along[1] - along[0]) / 2
    edges = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]]).astype(int)))
    spans = [
        (float(along[a] - half), float(along[b - 1] + half)) for a, b in zip(edges[::2], edges[1::2], strict=True)
    ]
    spans = _closed(spans, settings.thinnest)
    snapped = [
        (0.0 if low < settings.snap else low, length if length - high < settings.snap else high)
        for low, high in spans
    ]
    return [(low, high) for low, high in snapped if high - low >= min(settings.thinnest, 0.95 * length)]


def _closed(spans: list[tuple[float, float]], gap: float) -> list[tuple[float, float]]:
    """Spans joined over gaps that are too narrow to cut."""
    cuts = [0, *(k for k, (a, b) in enumerate(pairwise(spans), 1) if b[0] - a[1] >= gap), len(spans)]
    return [(spans[a][0], spans[b - 1][1]) for a, b in pairwise(cuts) if b > a]

"""Bounding boxes that a stray part or a thin mast does not stretch."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray, locked
from popsim.geometry.cluster import linked
from popsim.geometry.extent import extent
from popsim.geometry.surface import Surface
from popsim.mesh.sampling import Samples

LINK = 2.0
"""Samples within this many spacings hang together."""
TINY = 0.01
"""A part with less than this share of the area may be left out."""
FAR = 0.15
"""A tiny part counts as far if this much of the diagonal of the rest separates it from the rest."""
THIN = 0.005
"""An end that holds less than this share of the area may be thin."""
SLENDER = 0.1
"""It is if it takes up less than this share of the section of the box across it."""
LONG = 0.25
"""A thin end is cut off if it takes up more than this share of the extent; shorter ones stretch no box much."""
SKIN = 0.01
"""Share of the extent below the cut within which samples still belong to what the end stands on."""
FOOT = (2, 0)
"""Axis and side of the end that is never cut off: what a model stands on holds the rest up, however thin."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """Something that a robust box does not hold.

    Attributes
    ----------
    bounds:
        Its own lowest and highest corner, shape (2, 3).
    area_share:
        Its share of the area of the model, 0..1.
    reason:
        "far" or "thin".
    """

    bounds: FloatArray
    area_share: float
    reason: str

    def __str__(self) -> str:
        size = " x ".join(f"{s:.3g}" for s in self.bounds[1] - self.bounds[0])
        what = "a part far from the rest" if self.reason == "far" else "a thin end"
        return (
            f"{what}, {size} in size with {self.area_share:.2%} of the area, does not count for the bounding box"
        )


@dataclass(frozen=True, eq=False)
class RobustBounds:
    """A bounding box and what it leaves out.

    Attributes
    ----------
    bounds:
        Lowest and highest corner, shape (2, 3); exactly those of the surface where nothing is left out.
    left_out:
        Far parts first, then thin ends, in the order of the axes.
    """

    bounds: FloatArray
    left_out: tuple[LeftOut, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "bounds", locked(self.bounds, (2, 3), "bounds"))

    def shifted(self, shift: FloatArray) -> "RobustBounds":
        """Return the same, moved by `shift` (3,)."""
        parts = tuple(LeftOut(part.bounds + shift, part.area_share, part.reason) for part in self.left_out)
        return RobustBounds(self.bounds + shift, parts)


@dataclass(frozen=True, eq=False)
class Body:
    """What counts of a surface: all but tiny parts that lie far off; in the frame of the surface.

    Attributes
    ----------
    corners:
        Corners of its faces, shape (n, 3).
    points, weight:
        Samples on it, shape (k, 3), and the share of the whole area that each stands for, shape (k,).
    strays:
        Samples (s, 3) on each part that does not count, and its share of the area.
    """

    corners: FloatArray
    points: FloatArray
    weight: FloatArray
    strays: tuple[tuple[FloatArray, float], ...] = ()

    def extent(self, direction: FloatArray) -> tuple[float, float]:
        """Return how far it reaches along a direction (3,): least and greatest."""
        low, high = extent(self.corners, direction[None])[:, 0]
        return float(low), float(high)

    def box(self, rotation: FloatArray) -> RobustBounds:
        """Return its bounding box in the frame whose axes are the rows of `rotation` (3, 3), z up.

        Long ends with next to no area, as masts and antennas have, do not count.
        """
        bounds = extent(self.corners, rotation)
        far = [LeftOut(box_of(points @ rotation.T), share, "far") for points, share in self.strays]
        points = self.points @ rotation.T
        ends = []
        for axis in range(3):
            for side in range(2):
                end = None if (axis, side) == FOOT else _thin_end(bounds, points, self.weight, axis, side)
                if end is not None:
                    ends.append(end)
                    bounds[side, axis] = end.bounds[1 - side, axis]
        return RobustBounds(bounds, (*far, *ends))


def body_of(surface: Surface, samples: Samples) -> Body:
    """Tell what counts of a surface, given points on it in the same frame."""
    part = linked(samples.points, LINK * samples.spacing)
    far = _far_parts(samples, part)
    weight = samples.area / samples.area.sum()
    corners = surface.triangles
    if far:
        corners = corners[~np.isin(_part_of_faces(corners, samples, part), far)]
    strays = tuple((samples.points[part == k], float(weight[part == k].sum())) for k in far)
    kept = ~np.isin(part, far)
    return Body(corners.reshape(-1, 3), samples.points[kept], weight[kept], strays)


def box_of(points: FloatArray) -> FloatArray:
    """Return the lowest and the highest corner of points (n, 3), shape (2, 3)."""
    return np.array([points.min(axis=0), points.max(axis=0)])


def _far_parts(samples: Samples, part: IntArray) -> list[int]:
    """Return the tiny parts that stay far off while everything near the large ones joins them."""
    share = np.bincount(part, weights=samples.area) / samples.area.sum()
    large = (share >= TINY) | (share == share.max())
    boxes = np.array([box_of(samples.points[part == k]) for k in range(len(share))])
    inside = large
    while True:
        core = np.array([boxes[inside, 0].min(axis=0), boxes[inside, 1].max(axis=0)])
        gap = np.maximum(np.maximum(boxes[:, 0] - core[1], core[0] - boxes[:, 1]), 0)
        near = inside | (np.linalg.norm(gap, axis=1) <= FAR * np.linalg.norm(core[1] - core[0]))
        if (near == inside).all():
            return [int(k) for k in np.flatnonzero(~inside)]
        inside = near


def _part_of_faces(corners: FloatArray, samples: Samples, part: IntArray) -> IntArray:
    """Return the part of the sample that is nearest to the centre of each face (m, 3, 3)."""
    from scipy.spatial import cKDTree

    nearest: IntArray = part[cKDTree(samples.points).query(corners.mean(axis=1))[1]]
    return nearest


def _thin_end(bounds: FloatArray, points: FloatArray, weight: FloatArray, axis: int, side: int) -> LeftOut | None:
    """Return the thin long end at one side of the box along an axis, or None where the box ends otherwise."""
    inward = points[:, axis] if side == 0 else -points[:, axis]
    order = np.argsort(inward, kind="stable")
    below = np.cumsum(weight[order])
    first = int(np.searchsorted(below, THIN * below[-1]))
    cut = points[order[first], axis]
    size = bounds[1] - bounds[0]
    if not abs(cut - bounds[side, axis]) > LONG * size[axis]:
        return None
    beyond = inward < inward[order[first]] - SKIN * size[axis]
    if not beyond.any():
        return None
    box = box_of(points[beyond])
    box[side, axis], box[1 - side, axis] = bounds[side, axis], cut
    across = [k for k in range(3) if k != axis]
    if np.ptp(box, axis=0)[across].prod() > SLENDER * size[across].prod():
        return None
    return LeftOut(box, float(weight[beyond].sum()), "thin")

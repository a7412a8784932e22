"""Bounding boxes that a stray point or a thin antenna does not stretch."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray, locked
from popsim.geometry.surface import Surface
from popsim.mesh.sampling import Samples

LINK = 2.0
"""Samples within this many spacings hang together."""
TINY = 0.01
"""A part with less than this share of the area may be left out."""
FAR = 0.15
"""A tiny part counts as far if this much of the diagonal of the rest separates it from the rest."""
THIN = 0.005
"""An end that holds less than this share of the area is thin."""
LONG = 0.08
"""A thin end is cut off if it takes up more than this share of the extent."""


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


def robust_bounds(surface: Surface, samples: Samples, *, trim_thin: bool = False) -> RobustBounds:
    """Return the bounding box of what matters of a surface.

    Parameters
    ----------
    surface, samples:
        A surface and points on it, in the same frame; the box is in that frame too.
    trim_thin:
        Also cut off long ends with next to no area, like antennas.
    """
    part = _parts(samples)
    far = _far_parts(samples, part)
    corners = surface.triangles
    left_out = []
    kept = samples.points
    weight = samples.area / samples.area.sum()
    if far:
        stray = np.isin(_part_of_faces(corners, samples, part), far)
        for number in far:
            member = part == number
            left_out.append(LeftOut(_box(samples.points[member]), float(weight[member].sum()), "far"))
        corners = corners[~stray]
        inside = ~np.isin(part, far)
        kept, weight = kept[inside], weight[inside]
    bounds = _box(corners.reshape(-1, 3))
    if trim_thin:
        bounds, ends = _without_thin_ends(bounds, kept, weight)
        left_out += ends
    return RobustBounds(bounds, tuple(left_out))


def _box(points: FloatArray) -> FloatArray:
    return np.array([points.min(axis=0), points.max(axis=0)])


def _parts(samples: Samples) -> IntArray:
    """Number the groups of samples that hang together."""
    from scipy.sparse import coo_array  # slow import
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    count = len(samples.points)
    pairs = cKDTree(samples.points).query_pairs(LINK * samples.spacing, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    numbers: IntArray = connected_components(links, directed=False)[1]
    return numbers


def _far_parts(samples: Samples, part: IntArray) -> list[int]:
    """Return the tiny parts that stay far off while everything near the large ones joins them."""
    share = np.bincount(part, weights=samples.area) / samples.area.sum()
    large = (share >= TINY) | (share == share.max())
    boxes = np.array([_box(samples.points[part == k]) for k in range(len(share))])
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


def _without_thin_ends(
    bounds: FloatArray, points: FloatArray, weight: FloatArray
) -> tuple[FloatArray, list[LeftOut]]:
    trimmed, ends = bounds.copy(), []
    for axis in range(3):
        order = np.argsort(points[:, axis], kind="stable")
        below = np.cumsum(weight[order]) / weight.sum()
        along = points[order, axis]
        cuts = along[np.searchsorted(below, THIN)], along[np.searchsorted(below, 1 - THIN)]
        for side, cut in enumerate(cuts):
            if abs(cut - bounds[side, axis]) > LONG * (bounds[1, axis] - bounds[0, axis]):
                end = points[(points[:, axis] - cut) * (1 - 2 * side) < 0]
                lost = weight[(points[:, axis] - cut) * (1 - 2 * side) < 0].sum()
                box = _box(end)
                box[side, axis] = bounds[side, axis]
                ends.append(LeftOut(box, float(lost), "thin"))
                trimmed[side, axis] = cut
    return trimmed, ends

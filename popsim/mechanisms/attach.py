"""Where a hinge holds: a joint of two plates, clipped to the stretches on which both patches have paper."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import area_vector

if TYPE_CHECKING:
    from shapely.geometry import Polygon

Interval = tuple[float, float]

SHORTEST = 2.0
"""mm; a shorter stretch holds nothing, unless the whole axis is shorter."""

SLACK = 2e-3
"""mm; a line that runs along the border of an outline lies on it, in spite of rounding."""

OVERLAP = 0.5
"""mm^2; patches that overlap by more when they are laid out flat are two pieces of paper."""


@dataclass(frozen=True, eq=False)
class HingeLine:
    """The endless line of an axis, and patches as they lie beside it.

    Flat coordinates of a patch are (along, across): mm from the start of the axis, and from the line.
    """

    axis: FloatArray

    @property
    def length(self) -> float:
        """Length of the axis, mm."""
        return float(np.linalg.norm(self.axis[1] - self.axis[0]))

    def beside(self, patch: Patch) -> "Polygon":
        """The patch in flat coordinates; its larger part has across > 0."""
        from shapely.geometry import Polygon

        direction = (self.axis[1] - self.axis[0]) / self.length
        across = np.cross(patch.plane.normal, direction)

        def flat(ring: FloatArray) -> FloatArray:
            rel = ring - self.axis[0]
            return np.column_stack([rel @ direction, rel @ across])

        rings = [flat(patch.points), *(flat(hole) for hole in patch.hole_points)]
        weight = sum(_moment(ring) * sign for ring, sign in zip(rings, [1, *[-1] * (len(rings) - 1)], strict=True))
        turned = [ring * [1.0, -1.0 if weight < 0 else 1.0] for ring in rings]
        return Polygon(turned[0], turned[1:])

    def at(self, along: float) -> FloatArray:
        """Point of the line, shape (3,)."""
        start, end = self.axis
        if along in (0.0, self.length):
            return np.asarray(start if along == 0.0 else end)
        return np.asarray(start + (end - start) * (along / self.length))


def held_stretches(axis: FloatArray, first: Patch, second: Patch) -> list[FloatArray]:
    """Parts of the line of `axis` (2, 3) that lie on both patches, each of shape (2, 3), in order.

    They may reach beyond the axis where both outlines do: two rigid patches turn about the whole line.
    """
    line = HingeLine(axis)
    least = min(SHORTEST, line.length * 0.9)
    common = _common(_covered(line, first), _covered(line, second))
    ends = (0.0, line.length)
    snapped = [(_snapped(low, ends), _snapped(high, ends)) for low, high in common]
    return [np.array([line.at(low), line.at(high)]) for low, high in snapped if high - low >= least]


def lie_apart(axis: FloatArray, first: Patch, second: Patch) -> bool:
    """Whether the two patches, unfolded flat about `axis`, leave each other free: they can be one piece."""
    line = HingeLine(axis)
    one, two = line.beside(first), line.beside(second)
    from shapely import affinity

    return bool(one.buffer(0).intersection(affinity.scale(two, 1, -1, origin=(0, 0)).buffer(0)).area < OVERLAP)


def _moment(ring: FloatArray) -> float:
    """First moment about the line of the area in a flat ring (n, 2), counted positive for any orientation."""
    a, b = ring, np.roll(ring, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    spatial = area_vector(np.column_stack([ring, np.zeros(len(ring))]))[2]
    return float(((a[:, 1] + b[:, 1]) * cross).sum() * np.sign(spatial))


def _covered(line: HingeLine, patch: Patch) -> list[Interval]:
    from shapely import get_parts, intersection
    from shapely.geometry import LineString

    polygon = line.beside(patch)
    low, _, high, _ = polygon.bounds
    run = LineString([(low - 1, 0.0), (high + 1, 0.0)])
    pieces = get_parts(intersection(polygon.buffer(SLACK, join_style="mitre"), run))
    corners = _corners_on_line(polygon)
    spans = [
        (_snapped(piece.bounds[0] + SLACK, corners), _snapped(piece.bounds[2] - SLACK, corners))
        for piece in pieces
        if not piece.is_empty
    ]
    return _joined(sorted(span for span in spans if span[1] > span[0]))


def _corners_on_line(polygon: "Polygon") -> FloatArray:
    """Where corners of the polygon lie on the line: exact ends of what it covers, shape (n,)."""
    points = np.concatenate([np.array(ring.coords) for ring in (polygon.exterior, *polygon.interiors)])
    return np.asarray(points[np.abs(points[:, 1]) <= SLACK, 0])


def _joined(spans: list[Interval]) -> list[Interval]:
    """Spans with gaps that are mere rounding closed."""
    cuts = [0, *(k for k, (a, b) in enumerate(pairwise(spans), 1) if b[0] - a[1] > 3 * SLACK), len(spans)]
    return [(spans[a][0], spans[b - 1][1]) for a, b in pairwise(cuts) if b > a]


def _common(first: list[Interval], second: list[Interval]) -> list[Interval]:
    both = [(max(a[0], b[0]), min(a[1], b[1])) for a in first for b in second]
    return [span for span in both if span[0] < span[1]]


def _snapped(along: float, ends: npt.ArrayLike) -> float:
    """The one of `ends` that `along` is as good as at, or `along`."""
    for end in np.asarray(ends, float):
        if abs(along - end) < 4 * SLACK:
            return float(end)
    return along

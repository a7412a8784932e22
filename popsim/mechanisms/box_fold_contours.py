"""How far the patches of a box-fold may follow the contours of a model, and how deep the model shows on them.

In skew coordinates sides, backbone and tops do not move, and each end pair sweeps outward between the two sides,
lifted as it goes. So sides may rise above the tops, and reach along x where nothing else stands; tops may reach
beyond the sides, but not along x, where a pair passes; pairs may rise above the top behind them, from which they
move away. What of a pair is beyond a side turns about their hinge the other way: backward, and down. The backbone
may rise through a slit between the two halves of a top as a fin, below the path of the pairs that sweep over it.
"""

from itertools import combinations, pairwise
from typing import TYPE_CHECKING

import numpy as np

from popsim.mechanisms.plate import Point, rectangle

if TYPE_CHECKING:
    from popsim.mechanisms.box_fold import BoxFold, EndPair, Top

RISE = 5.0
"""Half widths by which sides and pairs may rise above the tops: gables, and signs and masts beside the fold."""

EAVES = 0.25
"""Half widths by which tops may reach beyond the sides."""

LONGEST_EAVES = 8.0
"""mm; more would be in the way of what stands beside the box."""

EARS = 0.35
"""Half widths by which end pairs may reach beyond the sides."""

LONGEST_EARS = 15.0
"""mm; as for eaves."""

FIN = 8.0
"""Half widths by which a fin may rise above its top: masts and funnels."""

FIN_DEPTH = 0.25
"""Half widths to either side of the backbone within which the model shows on a fin."""

SLIT_MARGIN = 5.0
"""mm of a top, or a quarter of a shorter one, that stay whole at each end of a slit."""

TOP_DEPTH = 0.75
"""Share of the drop beside a top down to which the model shows on it."""

FRONT_DEPTH = 0.2
"""Share of the length of the box to which the model shows on an outermost end pair: far enough for its wheels."""

STEP_DEPTH = 0.25
"""The same on a pair above a top: room for a slanted windscreen."""


def side_room(box: "BoxFold", y: float) -> list[Point]:
    """Room of a side in the plane y."""
    x0, x1 = min(box.pair.x[0], box.x[0]), max(box.pair.x[1], box.x[1])
    z0 = box.pair.v
    z1 = z0 + box.height + RISE * box.half_width
    return rectangle((x0, x1), (y, z0), (y, z1))


def backbone_room(box: "BoxFold") -> list[Point]:
    """Room of the backbone: its face, and fins over the tops."""
    ring = [(box.x[0], 0.0), (box.x[1], 0.0)]
    for top in reversed(box.tops):
        ring += [(top.x1, top.height), *_fin(box, top)[::-1], (top.x0, top.height)]
    corners = [point for k, point in enumerate(ring) if point != ring[k - 1]]
    return [(x, 0.0, box.pair.v + z) for x, z in corners]


def _fin(box: "BoxFold", top: "Top") -> list[tuple[float, float]]:
    """How high the backbone may rise over a top, as a path of (x, z) from its low to its high end.

    A pair sweeps, at a distance from where it stands, all that is as far or farther above its lower edge.
    """
    margin = min(SLIT_MARGIN, (top.x1 - top.x0) / 4)
    first, last = top.x0 + margin, top.x1 - margin
    level = 0.0, top.height, -np.inf, np.inf
    ceiling = 0.0, box.height + FIN * box.half_width, -np.inf, np.inf
    paths = [_swept(box, end) for end in box.end_pairs]
    lines = [ceiling, *(path for path in paths if path[2] < last and first < path[3])]
    borders = {first, last, *(x for line in lines[1:] for x in line[2:] if first < x < last)}
    for one, other in combinations([level, *lines], 2):
        if one[0] != other[0]:
            x = (other[1] - one[1]) / (one[0] - other[0])
            borders |= {x} if first < x < last else set()
    fin = [(first, top.height)]
    for x0, x1 in pairwise(sorted(borders)):
        middle = (x0 + x1) / 2
        over = [(slope, height) for slope, height, low, high in lines if low < middle < high]
        slope, height = min(over, key=lambda line: line[0] * middle + line[1])
        fin += [(x, max(slope * x + height, top.height)) for x in (x0, x1)]
    return [*fin, (last, top.height)]


def _swept(box: "BoxFold", end: "EndPair") -> tuple[float, float, float, float]:
    """Lower edge of what a pair sweeps: slope and height at x = 0 of a line, and from where to where it runs."""
    near, far = sorted((end.x, end.x + end.facing * box.half_width))
    return end.facing, end.low - end.facing * end.x, near, far


def top_room(box: "BoxFold", top: "Top", sign: int) -> list[Point]:
    """Room of one half of a top."""
    far = sign * (box.half_width + min(EAVES * box.half_width, LONGEST_EAVES))
    z = box.pair.v + top.height
    return rectangle((top.x0, top.x1), (0.0, z), (far, z))


def top_depth(box: "BoxFold", top: "Top") -> float:
    """How deep below a top the model shows on it, mm."""
    beside = [other.height for other in box.tops if top.x1 == other.x0 or other.x1 == top.x0]
    floor = max([height for height in beside if height < top.height], default=0.0)
    return TOP_DEPTH * (top.height - floor)


def end_room(box: "BoxFold", end: "EndPair", sign: int) -> list[Point]:
    """Room of one patch of an end pair.

    Its ear beyond the side swings back along the side's other face and sinks by as much as it reaches out, so it
    starts that high above the base, stays below the eaves of the top behind it, and leaves half of the way to a
    pair that faces the other way to the ears of that one.
    """
    low, high, w = end.low, end.high, box.half_width
    behind = [end.facing * (end.x - other.x) / 2 for other in box.end_pairs if other.facing == -end.facing]
    ear = min([EARS * w, LONGEST_EARS, high - low, *(half for half in behind if half > 0)])
    peak = high + RISE * w
    ring = [(0.0, low), (w, low), (w + ear, max(low, ear)), (w + ear, high), (w, high), (w, peak)]
    return [(end.x, sign * y, box.pair.v + z) for y, z in [*ring, (0.0, peak)]]


def end_depth(box: "BoxFold", end: "EndPair") -> float:
    """How deep behind an end pair the model shows on it, mm."""
    share = STEP_DEPTH if end.low > 0 else FRONT_DEPTH
    return share * (box.x[1] - box.x[0])

"""Two patches that both reach beyond their common hinge would cut through each other."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.patches.clean import common, without
from popsim.patches.hold import Run

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

REACH = 1e4
"""mm; beyond any patch."""

GROOVE = 0.3
"""mm beyond the line at which paper counts as reaching beyond it."""

TOUCH = 0.5
"""mm of line on which two patches may both reach beyond it."""


def uncross(first: Run, second: Run) -> None:
    """Cut the smaller of the two overhangs where the outlines of both pieces reach beyond their hinge line."""
    if first.inward is None or second.inward is None or first.piece is second.piece:
        return
    overhangs = [_overhang(run) for run in (first, second)]
    shared = _along(first, overhangs[0]).intersection(_along(second, overhangs[1]))
    if shared.length <= TOUCH:
        return
    run, overhang = min(zip((first, second), overhangs, strict=True), key=lambda pair: pair[1].area)
    run.piece.shape = without(run.piece.shape, overhang)


def _overhang(run: Run) -> "BaseGeometry":
    """The part of the outline beyond the axis, and not in the face."""
    assert run.inward is not None  # asked by the caller
    return without(common(run.piece.shape, _beyond(run, run.inward)), run.piece.face)


def _beyond(run: Run, inward: FloatArray) -> "Polygon":
    from shapely.geometry import Polygon

    start, end = run.ends
    return Polygon([start, end, end - REACH * inward, start - REACH * inward])


def _along(run: Run, overhang: "BaseGeometry") -> "BaseGeometry":
    """Where along the axis an overhang touches it, as a geometry on the number line."""
    from shapely import get_parts, intersection
    from shapely.geometry import LineString, MultiLineString

    assert run.inward is not None  # asked by the caller
    groove = LineString(run.ends - GROOVE * run.inward)
    direction = (run.ends[1] - run.ends[0]) / run.length
    spans = []
    for part in get_parts(intersection(overhang, groove)):
        if part.length > 0:
            low, high = np.sort((np.array(part.coords) - run.ends[0]) @ direction)[[0, -1]]
            spans.append([(float(low), 0.0), (float(high), 0.0)])
    return MultiLineString(spans)

"""Two patches that both reach beyond their common hinge would cut through each other."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.patches.clean import common, without
from popsim.patches.hold import Run
from popsim.patches.piece import Piece
from popsim.stock import MAY_CROSS, NEAR_EDGE, worth_beyond

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

REACH = 1e4
"""mm; beyond any patch."""

GROOVE = 0.3
"""mm beyond the line at which paper counts as reaching beyond it."""

SAME_LINE = 1e-3
"""mm; axes nearer than this are on one line."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """Pieces that are hinged along an axis.

    Attributes
    ----------
    axis:
        Ends of the line in the open pose, shape (2, 3).
    pieces:
        Those of them that are cut.
    names:
        Ids of both patches.
    snap:
        Outlines nearer than this reach the line, mm.
    """

    axis: FloatArray
    pieces: list[Piece]
    names: tuple[str, ...] = ()
    snap: float = NEAR_EDGE

    def runs(self) -> list[Run]:
        """The axis on each of the pieces."""
        return [Run.of(piece, self.axis) for piece in self.pieces]

    def mates(self, meetings: Iterable["Meeting"]) -> list[Run]:
        """The axis on what else is hinged to one of these on the same axis, in one of some meetings."""
        own = {id(piece) for piece in self.pieces}
        beside = [other for other in meetings if own & {id(piece) for piece in other.pieces}]
        same = [other for other in beside if np.allclose(other.axis, self.axis)]
        pieces = {id(piece): piece for other in same for piece in other.pieces}
        return [Run.of(piece, self.axis) for key, piece in pieces.items() if key not in own]


def uncross(meetings: Sequence[Meeting]) -> None:
    """Cut that of two overhangs which is worth less where two pieces that end at one line both reach beyond it.

    Pieces may share a line without a hinge between them: a side and the roof slope on the top that it carries.
    """
    for index, meeting in enumerate(meetings):
        pieces = {id(piece): piece for piece in meeting.pieces}
        for other in meetings[index + 1 :]:
            if _on_one_line(meeting.axis, other.axis):
                pieces |= {id(piece): piece for piece in other.pieces}
        for first, second in combinations(pieces.values(), 2):
            _uncross(Run.of(first, meeting.axis), Run.of(second, meeting.axis))


def _on_one_line(first: FloatArray, second: FloatArray) -> bool:
    """Whether two axes lie on one line and overlap."""
    if line_distance(second, first).max() > SAME_LINE:
        return False
    along = (second - first[0]) @ (first[1] - first[0])
    return bool(along.max() > 0 and along.min() < (first[1] - first[0]) @ (first[1] - first[0]))


def _uncross(first: Run, second: Run) -> None:
    """Cut the overhang of less worth, stretch by stretch of the line where both reach beyond it."""
    from shapely import get_parts

    if first.inward is None or second.inward is None:
        return
    overhangs = [_overhang(run) for run in (first, second)]
    shared = touched(first, overhangs[0]).intersection(touched(second, overhangs[1]))
    for part in get_parts(shared):
        if part.length <= MAY_CROSS:
            continue
        low, high = part.bounds[0] - GROOVE, part.bounds[2] + GROOVE
        # places are counted from the start of the first run's axis, and both runs have the same axis
        bands = [common(over, _band(run, low, high)) for run, over in zip((first, second), overhangs, strict=True)]
        both = zip((first, second), bands, strict=True)
        run, band = min(both, key=lambda pair: worth_beyond(lies=pair[0].piece.plate.lies) * pair[1].area)
        run.piece.shape = without(run.piece.shape, band)


def _overhang(run: Run) -> "BaseGeometry":
    """The part of the outline beyond the axis, and not in the face."""
    assert run.inward is not None  # asked by the caller
    return without(common(run.piece.shape, beyond(run, run.inward)), run.piece.face)


def beyond(run: Run, inward: FloatArray) -> "Polygon":
    """Everything on the other side of the axis than `inward`, alongside it."""
    from shapely.geometry import Polygon

    start, end = run.ends
    return Polygon([start, end, end - REACH * inward, start - REACH * inward])


def _band(run: Run, low: float, high: float) -> "Polygon":
    """Everything beyond a stretch of the axis."""
    from shapely.geometry import Polygon

    assert run.inward is not None  # asked by the caller
    direction = (run.ends[1] - run.ends[0]) / run.length
    start, end = run.ends[0] + low * direction, run.ends[0] + high * direction
    return Polygon([start, end, end - REACH * run.inward, start - REACH * run.inward])


def touched(run: Run, overhang: "BaseGeometry") -> "BaseGeometry":
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

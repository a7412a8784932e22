"""Slits through which fins rise: where a patch inside goes on beyond a hinge line, the patch there gives way.

Where too little of the hinge would be left, the fin stands on a narrower neck; with too little for that, there is
none.
"""

from collections.abc import Collection, Sequence
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from popsim.patches.clean import polygons, tidy, union, without
from popsim.patches.crossing import Meeting, beyond, touched
from popsim.patches.hold import WITHIN, Run
from popsim.patches.one_piece import in_one_piece
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

WIDTH = 0.8
"""mm; what paper of any weight passes."""

STEP = 0.25
"""mm between the places along a line where outlines are looked for."""

NOTCH = 2.0
"""mm over the line up to which a fin is cut beside its neck: its patch and the flaps there pass below it."""

NECK = 6.0
"""mm; on less no fin stands."""

PLAY = 0.5
"""mm by which a slit is longer than its fin at either end."""


def cut_slits(meetings: Collection[Meeting], outlines: dict[str, "Polygon"], settings: PatchSettings) -> None:
    """Cut slits for the fins of patches inside into the outlines of what is hinged to them, in place."""
    for meeting in meetings:
        for fin, host in permutations(meeting.runs(), 2):
            if not fin.piece.plate.principal and host.piece.plate.principal:
                slit(fin, host, meeting.mates(meetings), outlines, settings)


def slit(
    fin: Run, host: Run, mates: Sequence[Run], outlines: dict[str, "Polygon"], settings: PatchSettings
) -> None:
    """Cut the slits of one fin along one line into the outline of the host.

    Where they would leave too little of the hinge, or of those of the host with `mates` on the same line, the fin
    gets a narrower neck or, at last, is cut off.
    """
    if fin.inward is None or host.inward is None:
        return
    inner, outer = fin.piece.id, host.piece.id
    spans = _spans(fin, outlines[inner])
    if not spans:
        return
    plain = _whole(fin, without(outlines[inner], beyond(fin, fin.inward)))
    least = settings.least_hold(fin.length)
    hinges = [(fin, plain, least)]
    for mate in mates:
        outline = outlines[mate.piece.id]
        hinges.append((mate, outline, min(least, _held(mate, host, outline, outlines[outer]))))

    def lacking(left: "BaseGeometry") -> float:
        """How much of its line the worst hinge lacks, mm, with the host cut to `left`."""
        return max(needed - _held(run, host, outline, left) for run, outline, needed in hinges)

    lack = lacking(without(outlines[outer], _slits(host, spans)))
    choices = [outlines[inner]] if lack <= 0 else [*_necked(fin, outlines[inner], spans, lack), plain]
    for choice in choices:
        left = polygons(without(outlines[outer], _slits(host, _spans(fin, choice))))
        if left and (choice is plain or lacking(left[0]) <= 0):
            outlines[inner], outlines[outer] = choice, tidy(left[0])
            return


def _necked(fin: Run, outline: "Polygon", spans: Sequence[tuple[float, float]], lack: float) -> list["Polygon"]:
    """The fin with its widest foot narrower by a bit more than `lack`, the largest first; none on too little."""
    low, high = max(spans, key=lambda span: span[1] - span[0])
    neck = high - low - lack - 2 * PLAY - STEP
    if neck < NECK:
        return []
    found = []
    for start in (low, (low + high - neck) / 2, high - neck):
        notches = [
            _above(fin, a, b) for a, b in ((low - PLAY, start), (start + neck, high + PLAY)) if b - a > PLAY
        ]
        found.append(_whole(fin, without(outline, union(*notches))))
    return sorted(found, key=lambda each: -each.area)


def _whole(fin: Run, shape: "BaseGeometry") -> "Polygon":
    """What is left of a fin and its patch, as one piece that still reaches all its hinges."""
    outline, _ = in_one_piece(polygons(shape), fin.piece)
    return fin.piece.face if outline is None else tidy(outline)


def _above(fin: Run, low: float, high: float) -> "Polygon":
    """A notch in the fin, right above a stretch of its line."""
    from shapely.geometry import Polygon

    assert fin.inward is not None  # asked by the caller
    start, end = fin.places(np.array([low, high]))
    return Polygon([start, end, end - NOTCH * fin.inward, start - NOTCH * fin.inward])


def _held(fin: Run, host: Run, inner: "Polygon", outer: "Polygon") -> float:
    """How much of the line both outlines reach, mm."""
    import shapely

    count = max(4, round(fin.length / STEP))
    along = np.asarray((np.arange(count) + 0.5) * (fin.length / count), np.float64)
    both = np.ones(count, dtype=bool)
    for run, outline in ((fin, inner), (host, outer)):
        assert run.inward is not None  # there are no slits without
        both &= shapely.contains_xy(outline, *(run.places(along) + WITHIN * run.inward).T)
    return float(both.sum() * fin.length / count)


def _spans(fin: Run, outline: "Polygon") -> list[tuple[float, float]]:
    """Stretches of the line at which a fin passes it, mm from the start."""
    from shapely import get_parts

    rising = without(outline, fin.piece.face)
    return [(float(span.bounds[0]), float(span.bounds[2])) for span in get_parts(touched(fin, rising))]


def _slits(host: Run, spans: Sequence[tuple[float, float]]) -> "BaseGeometry":
    """Slits for stretches of one line, in the flat coordinates of the host."""
    from shapely.geometry import Polygon

    assert host.inward is not None  # asked by the caller
    found = []
    for low, high in spans:
        start, end = host.places(np.array([low - PLAY, high + PLAY]))
        found.append(Polygon([start, end, end + WIDTH * host.inward, start + WIDTH * host.inward]))
    return union(*found) if found else Polygon()

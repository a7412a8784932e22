"""Slits through which fins rise: where a patch inside goes on beyond a hinge line, the patch there gives way.

Where too little of the hinge would be left, there is no fin.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from popsim.mechanisms import Mechanism
from popsim.patches.clean import polygons, tidy, without
from popsim.patches.crossing import beyond, touched
from popsim.patches.hold import WITHIN, Run, least_hold
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon

WIDTH = 0.8
"""mm; what paper of any weight passes."""

STEP = 0.25
"""mm between the places along a line where outlines are looked for."""

PLAY = 0.5
"""mm by which a slit is longer than its fin at either end."""


def cut_slits(
    mechanisms: Sequence[Mechanism],
    pieces: Mapping[str, Piece],
    outlines: dict[str, "Polygon"],
    settings: PatchSettings,
) -> None:
    """Cut slits for the fins of patches inside into the outlines of what is hinged to them, in place."""
    for mechanism in mechanisms:
        for joint in mechanism.joints():
            names = [mechanism.patch_id(role) for role in joint.roles]
            if any(name not in pieces for name in names):
                continue
            for inner, outer in (names, names[::-1]):
                if not pieces[inner].plate.principal and pieces[outer].plate.principal:
                    _slit(Run.of(pieces[inner], joint.axis), Run.of(pieces[outer], joint.axis), outlines, settings)


def _slit(fin: Run, host: Run, outlines: dict[str, "Polygon"], settings: PatchSettings) -> None:
    """Cut the slits of one fin along one line into the outline of the host, or the fin off its patch."""
    slits = _slits(fin, host, outlines)
    if slits.is_empty:
        return
    inner, outer = fin.piece.id, host.piece.id
    left = polygons(without(outlines[outer], slits))
    if left and _held(fin, host, outlines[inner], left[0]) >= least_hold(fin.length, settings):
        outlines[outer] = tidy(left[0])
        return
    assert fin.inward is not None  # there are no slits without
    outlines[inner] = tidy(polygons(without(outlines[inner], beyond(fin, fin.inward)))[0])


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


def _slits(fin: Run, host: Run, outlines: Mapping[str, "Polygon"]) -> "Polygon":
    """All slits of one fin along one line, in the flat coordinates of the host."""
    from shapely import get_parts, union_all
    from shapely.geometry import Polygon

    if fin.inward is None or host.inward is None:
        return Polygon()
    rising = without(outlines[fin.piece.id], fin.piece.face)
    found = []
    for span in get_parts(touched(fin, rising)):
        low, high = span.bounds[0] - PLAY, span.bounds[2] + PLAY
        start, end = host.places(np.array([low, high]))
        found.append(Polygon([start, end, end + WIDTH * host.inward, start + WIDTH * host.inward]))
    return union_all(found)

"""Slits through which fins rise: where a patch inside goes on beyond a hinge line, the patch there gives way."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from popsim.mechanisms import Mechanism
from popsim.patches.clean import polygons, tidy, without
from popsim.patches.crossing import touched
from popsim.patches.hold import Run
from popsim.patches.piece import Piece

if TYPE_CHECKING:
    from shapely.geometry import Polygon

WIDTH = 0.8
"""mm; what paper of any weight passes."""

PLAY = 0.5
"""mm by which a slit is longer than its fin at either end."""


def cut_slits(
    mechanisms: Sequence[Mechanism], pieces: Mapping[str, Piece], outlines: dict[str, "Polygon"]
) -> None:
    """Cut slits for the fins of patches inside into the outlines of what is hinged to them, in place."""
    for mechanism in mechanisms:
        for joint in mechanism.joints():
            names = [mechanism.patch_id(role) for role in joint.roles]
            if any(name not in pieces for name in names):
                continue
            for inner, outer in (names, names[::-1]):
                if not pieces[inner].plate.principal and pieces[outer].plate.principal:
                    slits = _slits(Run.of(pieces[inner], joint.axis), Run.of(pieces[outer], joint.axis), outlines)
                    left = polygons(without(outlines[outer], slits))
                    if not slits.is_empty and left:
                        outlines[outer] = tidy(left[0])


def _slits(fin: Run, host: Run, outlines: Mapping[str, "Polygon"]) -> "Polygon":
    """All slits of one fin along one line, in the flat coordinates of the host."""
    from shapely import get_parts, union_all
    from shapely.geometry import Polygon

    if fin.inward is None or host.inward is None:
        return Polygon()
    beyond = without(outlines[fin.piece.id], fin.piece.face)
    found = []
    for span in get_parts(touched(fin, beyond)):
        low, high = span.bounds[0] - PLAY, span.bounds[2] + PLAY
        start, end = host.places(np.array([low, high]))
        found.append(Polygon([start, end, end + WIDTH * host.inward, start + WIDTH * host.inward]))
    return union_all(found)

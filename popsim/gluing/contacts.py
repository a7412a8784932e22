"""Flaps that get in the way while the card folds.

A flap lies on its target, so what passes through the target is not asked again here. What can still go wrong is
what touches the target without passing through it: a patch that stands or slides on the face where the flap lies.

Paper gives where layers are pressed together. Where a fold closes over a flap of thickness t that ends t + KNIFE
beside it, the flap is nipped before the fold is flat, first at its rim. Plates that lie flatter on each other than
PRESSED for each flap between them, and nips up to NIP wide, are that and nothing worse.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common
from popsim.geometry.plane import common_line
from popsim.geometry.rigid import transform
from popsim.gluing.plates import plate_id, with_flaps
from popsim.layout import Flap, KeepOff, Part
from popsim.layout.flaps import InTheWay
from popsim.simulation import Sweep
from popsim.simulation.candidates import candidate_pairs
from popsim.simulation.contact import searched_frames

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

PRESSED = np.radians(15)
"""rad; plates with one flap between them that are flatter on each other than this are pressed together."""

NIP = 0.5
"""mm; what reaches no farther into a flap from its rim is what paper gives."""

LEAST = 0.05
"""mm; as far must plates reach through each other's planes at least."""

SAMPLES = 9
"""Places along a cut at which its distance from the rim is taken."""

FAR = 1e5
"""mm; beyond all paper."""


@dataclass(frozen=True, eq=False)
class FlapContact:
    """Something in the way of a flap.

    Attributes
    ----------
    flap:
        The flap.
    other:
        Id of the patch that it touches, or of another flap as :func:`popsim.gluing.plates.plate_id` has it.
    theta:
        Fold angle at which that is worst, rad.
    bite:
        How far from its rim the flap is cut there, mm.
    lines:
        Where the other cuts the plane of the flap at any angle, in the flat coordinates of the flap's target, each
        of shape (2, 2).
    """

    flap: Flap
    other: str
    theta: float
    bite: float
    lines: tuple[FloatArray, ...]


def find_flap_contacts(
    parts: Mapping[str, Part], flaps: tuple[Flap, ...], sweep: Sweep, thickness: float
) -> tuple[FlapContact, ...]:
    """All flaps that touch what they should not at some recorded angle, in their order.

    Parameters
    ----------
    parts, flaps:
        Of the layout of the design that was folded.
    sweep:
        Its motion.
    thickness:
        Of the paper, mm.
    """
    folded = with_flaps(parts, flaps, sweep, thickness)
    plates = {plate_id(flap): flap for flap in flaps}
    found = []
    for candidate in candidate_pairs(folded, searched_frames(sweep, LEAST), LEAST):
        ids = [folded.design.patches[k].id for k in candidate.pair]
        for own, other in (ids, ids[::-1]):
            if own in plates:
                cuts = [cut for frame in candidate.angles for cut in _cuts(folded, own, other, frame, plates)]
                if cuts:
                    found.append(_contact(parts[plates[own].target], folded, plates[own], other, cuts))
    order = {name: k for k, name in enumerate(plates)}
    return tuple(sorted(found, key=lambda contact: (order[plate_id(contact.flap)], contact.other)))


def keeping_clear(sweep: Sweep, thickness: float) -> InTheWay:
    """What :func:`popsim.layout.lay_out` asks where flaps are in the way of a folding design."""

    def in_the_way(parts: Mapping[str, Part], flaps: tuple[Flap, ...]) -> tuple[KeepOff, ...]:
        contacts = find_flap_contacts(parts, flaps, sweep, thickness)
        return tuple(KeepOff(one.flap.target, one.flap.face, line) for one in contacts for line in one.lines)

    return in_the_way


@dataclass(frozen=True, eq=False)
class _Cut:
    """A flap cut at one recorded angle: how deep, and along which line, in the open pose of its target (2, 3)."""

    frame: int
    bite: float
    line: FloatArray


def _contact(target: Part, folded: Sweep, flap: Flap, other: str, cuts: list[_Cut]) -> FlapContact:
    worst = max(cuts, key=lambda cut: cut.bite)
    lines = tuple(target.flat(cut.line) for cut in cuts)
    return FlapContact(flap, other, float(folded.theta[worst.frame]), worst.bite, lines)


def _cuts(folded: Sweep, own: str, other: str, frame: int, flaps: dict[str, Flap]) -> Iterator[_Cut]:
    """How plate `own` is cut by `other` at a recorded angle, unless they are only pressed together."""
    import shapely

    mine, theirs = (folded.design.patch_by_id[name] for name in (own, other))
    relative = np.linalg.inv(folded.poses[frame, folded.index[own]]) @ folded.poses[frame, folded.index[other]]
    normal = relative[:3, :3] @ theirs.plane.normal
    sine = float(np.linalg.norm(np.cross(mine.plane.normal, normal)))
    if sine < np.sin(PRESSED * (1 + (other in flaps))):
        return
    line = common_line(mine.plane, theirs.plane.moved(relative))
    cut = common(_along(mine, line), _along(theirs, transform(np.linalg.inv(relative), line)))
    rim = mine.plane.polygon(mine.points).boundary
    for piece in shapely.get_parts(cut):
        if piece.is_empty:
            continue
        start, end = shapely.get_coordinates(piece)[[0, -1], 0]
        along = np.linspace(start, end, SAMPLES)[:, None]
        spots = line[0] + along * (line[1] - line[0])
        depths = shapely.distance(shapely.points(mine.plane.flat(spots)), rim)
        if depths.max() > NIP:
            yield _Cut(frame, float(depths.max()), spots[[0, -1]])


def _along(patch: Patch, line: FloatArray) -> "BaseGeometry":
    """Where a line (2, 3) in the plane of a patch runs over it, as stretches of the x axis, mm from its start."""
    import shapely

    start, end = patch.plane.flat(line)
    along = (end - start) / np.linalg.norm(end - start)
    across = np.array([-along[1], along[0]])
    polygon = patch.plane.polygon(patch.points, patch.hole_points)
    turned = shapely.transform(polygon, lambda spots: (spots - start) @ np.stack([along, across], axis=1))
    return turned.intersection(shapely.LineString([(-FAR, 0.0), (FAR, 0.0)]))

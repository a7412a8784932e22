"""Flaps that get in the way while the card folds.

A flap lies on its target, so what passes through the target is not asked again here. What can still go wrong is
what touches the target without passing through it: a patch that stands or slides on the face where the flap lies.

Paper gives where layers are pressed together. Where a fold closes over a flap of thickness t that ends t + KNIFE
beside it, the flap is nipped before the fold is flat, first at its rim. Plates that lie flatter on each other than
PRESSED for each flap between them, and nips up to NIP wide, are that and nothing worse.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray, cross
from popsim.geometry.chords import chords, edges_of, shared
from popsim.geometry.plane import common_line
from popsim.geometry.rigid import transform
from popsim.gluing.plates import plate_id, with_flaps
from popsim.layout import Flap, KeepOff, Part
from popsim.layout.flaps import InTheWay
from popsim.simulation import Sweep
from popsim.simulation.candidates import candidate_pairs
from popsim.simulation.contact import searched_frames

if TYPE_CHECKING:
    from shapely.geometry import LinearRing

PRESSED = np.radians(15)
"""rad; plates with one flap between them that are flatter on each other than this are pressed together."""

NIP = 0.5
"""mm; what reaches no farther into a flap from its rim is what paper gives."""

LEAST = 0.05
"""mm; as far must plates reach through each other's planes at least."""

SAMPLES = 9
"""Places along a cut at which its distance from the rim is taken."""


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
    by_id = {plate_id(flap): flap for flap in flaps}
    plates = [_Plate(patch) for patch in folded.design.patches]
    names = [patch.id for patch in folded.design.patches]
    found = []
    for candidate in candidate_pairs(folded, searched_frames(sweep, LEAST), LEAST):
        for own, other in (candidate.pair, candidate.pair[::-1]):
            flap = by_id.get(names[own])
            if flap is None:
                continue
            pressed = PRESSED * (1 + (names[other] in by_id))
            pair = plates[own], plates[other]
            cuts = [cut for k in candidate.angles for cut in _cuts(folded, pair, (own, other), k, pressed)]
            if cuts:
                found.append(_contact(parts[flap.target], folded, flap, names[other], cuts))
    order = {name: k for k, name in enumerate(by_id)}
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


class _Plate:
    """A patch with what is asked of it again and again, flat."""

    def __init__(self, patch: Patch) -> None:
        self.plane = patch.plane
        self.outline = self.plane.flat(patch.points)
        self.edges = edges_of([self.outline, *(self.plane.flat(hole) for hole in patch.hole_points)])

    @cached_property
    def rim(self) -> "LinearRing":
        """The outline."""
        import shapely

        return shapely.LinearRing(self.outline)


def _cuts(
    folded: Sweep, plates: tuple[_Plate, _Plate], at: tuple[int, int], frame: int, pressed: float
) -> Iterator[_Cut]:
    """How the first of two plates is cut by the other at a recorded angle, unless they are only pressed together.

    `at`: their places in the sweep; `pressed`: how flat on each other they are then, rad.
    """
    import shapely

    mine, theirs = plates
    poses = folded.poses[frame, list(at)]
    relative = np.linalg.inv(poses[0]) @ poses[1]
    normal = relative[:3, :3] @ theirs.plane.normal
    if np.linalg.norm(cross(mine.plane.normal, normal)) < np.sin(pressed):
        return
    line = common_line(mine.plane, theirs.plane.moved(relative))
    back = transform(np.linalg.inv(relative), line)
    for stretch in shared(
        chords(mine.edges, mine.plane.flat(line)), chords(theirs.edges, theirs.plane.flat(back))
    ):
        spots = line[0] + np.linspace(stretch[0], stretch[1], SAMPLES)[:, None] * (line[1] - line[0])
        depths = shapely.distance(shapely.points(mine.plane.flat(spots)), mine.rim)
        if depths.max() > NIP:
            yield _Cut(frame, float(depths.max()), spots[[0, -1]])

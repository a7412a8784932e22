"""Sites: the ways in which a flap on one part can land on another, and which of them stay out of sight."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import left_of
from popsim.layout.contact import Contact
from popsim.layout.folding import FLAT, Crease, bend, into
from popsim.layout.joints import Joint
from popsim.layout.parts import Part

CROWDED = 4
"""Added to the rank of a flap on an edge where other joints run: their flaps would need the same edge."""


class Face(Enum):
    """A side of the paper; the value is its sign along the printed normal."""

    PRINTED = 1
    REVERSE = -1


@dataclass(frozen=True, eq=False)
class Site:
    """A flap along one stretch of a joint: who carries it, where it lands.

    Attributes
    ----------
    joint, stretch:
        The joint and the index of its stretch.
    carrier, target:
        The two parts.
    on_carrier, on_target:
        Matrices (3, 3) from strip coordinates (along the stretch, away from it; mm) to the parts' flat ones.
    length:
        Of the stretch, mm.
    face:
        The face of the target that is glued.
    crease:
        How the flap folds, seen from the printed side of its carrier.
    glue_on_print:
        Whether the flap's printed side is the one that gets the glue.
    rank:
        How well the flap hides, less is better.
    slot:
        Whether the flap stands in an opening of its carrier, through which the target passes.
    """

    joint: Joint
    stretch: int
    carrier: Part
    target: Part
    on_carrier: FloatArray
    on_target: FloatArray
    length: float
    face: Face
    crease: Crease
    glue_on_print: bool
    rank: int
    slot: bool = False


def sites(
    joint: Joint,
    stretch: int,
    parts: tuple[Part, Part],
    seen: tuple[Contact, Contact],
    free: tuple[bool, bool],
    alone: tuple[bool, bool],
) -> Iterator[Site]:
    """All sites of a stretch.

    Parameters
    ----------
    parts, seen:
        The two parts, and the stretch as they see it.
    free:
        For each part, whether the stretch is a cut edge of its net.
    alone:
        For each part, whether no other joint runs there, so that a flap can go round the edge to either face.
    """
    for one, other in ((0, 1), (1, 0)):
        if not (seen[one].is_edge and free[one]):
            continue
        inside = not (seen[other].is_edge and free[other] and alone[other])
        for side, paper in ((1, seen[other].left), (-1, seen[other].right)):
            if paper:
                pair, views = (parts[one], parts[other]), (seen[one], seen[other])
                yield from _landings(joint, stretch, pair, views, side, inside, 0 if alone[one] else CROWDED)


def _landings(
    joint: Joint,
    stretch: int,
    parts: tuple[Part, Part],
    seen: tuple[Contact, Contact],
    side: int,
    inside: bool,
    rank: int,
) -> Iterator[Site]:
    """Sites on one side of the line; `inside` the target's paper only the carrier's own face is reached."""
    carrier, target = parts
    normal, back = carrier.plane.normal, into(carrier, seen[0])
    ahead = into(target, seen[1], side)
    near = float(target.plane.normal @ back)
    outward = -1 if seen[0].left else 1
    for face in Face:
        reached = abs(near) < FLAT or face.value * near > 0
        if joint.hinge is None and face is Face.PRINTED:
            continue
        if inside and not reached and joint.hinge is not None:
            continue
        hidden = face is Face.REVERSE or normal @ ahead < -FLAT
        yield Site(
            joint=joint,
            stretch=stretch,
            carrier=carrier,
            target=target,
            on_carrier=strip(seen[0].ends, outward),
            on_target=strip(seen[1].ends, side),
            length=seen[0].length,
            face=face,
            crease=Crease.NONE if joint.hinge is None else bend(normal, ahead, joint.hinge),
            glue_on_print=glue_on_print(normal, back, ahead, face.value * target.plane.normal),
            rank=rank + (0 if hidden else 2) + (0 if reached else 1),
        )


def strip(ends: FloatArray, side: int) -> FloatArray:
    """Matrix from strip coordinates to flat ones; the strip lies to the left (1) or right (-1) of `ends`."""
    across = left_of(ends)
    matrix = np.eye(3)
    matrix[:2, 0], matrix[:2, 1], matrix[:2, 2] = (across[1], -across[0]), side * across, ends[0]
    return matrix


def glue_on_print(normal: FloatArray, back: FloatArray, ahead: FloatArray, face: FloatArray) -> bool:
    """Whether the printed side of a flap, folded from -`back` to `ahead`, meets the face with outer normal `face`.

    The fold carries the frame (-back, axis, normal) to (ahead, axis, printed side of the flap).
    """
    axis = np.cross(normal, -back)
    return bool(np.cross(ahead, axis) @ face < 0)

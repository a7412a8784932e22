"""All that lies ready before the first step: parts, their outlines, how they move, flaps and where they land."""

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np

from popsim.assembly.flap_motion import FlapMotion, flap_motions
from popsim.assembly.outline import Outline
from popsim.assembly.reference import Reference
from popsim.assembly.roll import Roll
from popsim.assembly.scene import FlapKey
from popsim.assembly.swings import Swings
from popsim.assembly.twins import Twins, twins
from popsim.design import GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import transform
from popsim.layout import Flap, Joint, Layout
from popsim.simulation import Sweep

ONE_LINE = 0.3
"""mm; joints this near to one line turn about it together."""


class Kit:
    """A layout with the recorded motion of its design.

    Attributes
    ----------
    layout:
        What is put together.
    reference:
        The recorded motion by part.
    opened:
        Fold angles, degrees, at which glue gets to a joint among some parts, as far as was asked, by its id and
        theirs; None where it is shut in at all that were tried.
    """

    def __init__(self, layout: Layout, sweep: Sweep) -> None:
        self.layout = layout
        self.reference = Reference(layout, sweep)
        self.opened: dict[tuple[str, frozenset[str]], float | None] = {}

    @cached_property
    def outlines(self) -> dict[str, Outline]:
        """Outlines of all parts, by id."""
        return {name: Outline.of(part) for name, part in self.layout.parts.items()}

    @cached_property
    def twins(self) -> Twins:
        """The mirror images of each glue joint, by its id."""
        return twins(self.layout, self.ends)

    @cached_property
    def swings(self) -> Swings:
        """What runs into what on the way, as far as was asked."""
        return Swings(self.outlines)

    @cached_property
    def roll(self) -> Roll:
        """Of all parts, in the order of the layout."""
        return Roll(self.layout.parts)

    @cached_property
    def joints(self) -> dict[str, Joint]:
        """All joints by id."""
        return {joint.id: joint for joint in self.layout.joints}

    @cached_property
    def ends(self) -> dict[str, FloatArray]:
        """Ends of the line of each joint in the open pose, by its id, each of shape (2, 3)."""
        return {joint.id: _ends(joint) for joint in self.layout.joints}

    @cached_property
    def in_line(self) -> dict[str, frozenset[str]]:
        """The joints on one line with each joint in the folded pop-up, by its id."""
        flat, joints = self.reference.flat, self.layout.joints
        ends = np.array([transform(flat[joint.parts[0]], self.ends[joint.id]) for joint in joints])
        near = np.array([line_distance(ends, line).max(axis=1) < ONE_LINE for line in ends])
        return {
            joint.id: frozenset(joints[k].id for k in np.flatnonzero(near[:, place]))
            for place, joint in enumerate(joints)
        }

    @cached_property
    def flaps_of(self) -> dict[str, tuple[Flap, ...]]:
        """The flaps of each glue joint, by its id."""
        found: dict[str, tuple[Flap, ...]] = {}
        for flap in self.layout.flaps:
            found[flap.joint.id] = (*found.get(flap.joint.id, ()), flap)
        return found

    @cached_property
    def flap_motions(self) -> dict[FlapKey, FlapMotion]:
        """How each flap turns, by key."""
        return flap_motions(self.layout)

    @cached_property
    def spots(self) -> dict[FlapKey, FloatArray]:
        """Places where each flap is pressed on its landing, in the open pose, by key, each of shape (3, 3)."""
        return {key: self._spots(motion.flap) for key, motion in self.flap_motions.items()}

    @cached_property
    def grounds(self) -> frozenset[str]:
        """Ids of the parts of the ground: one, or several where it is divided."""
        return frozenset(name for name, part in self.layout.parts.items() if part.patch.id == GROUND_ID)

    def ground(self, parts: Iterable[str]) -> str | None:
        """The part of the ground among some parts, the first where it is divided; None where it is not there."""
        return min(self.grounds.intersection(parts), default=None)

    def face(self, flap: Flap) -> FloatArray:
        """Unit normal out of the face on which a flap lands, in the open pose, shape (3,)."""
        return np.asarray(flap.face.value * self.layout.parts[flap.target].plane.normal)

    def size(self, poses: Mapping[str, FloatArray]) -> float:
        """Diagonal of the box around some parts at poses (4, 4), mm."""
        points = np.concatenate([transform(pose, self.outlines[name].points) for name, pose in poses.items()])
        return float(np.linalg.norm(np.ptp(points, axis=0)))

    def _spots(self, flap: Flap) -> FloatArray:
        middle = np.array(flap.landing.representative_point().coords[0])
        plane = self.layout.parts[flap.target].plane
        ends = plane.flat(self.layout.parts[flap.carrier].plane.lift(flap.line))
        return plane.lift(np.array([middle, (middle + ends[0]) / 2, (middle + ends[1]) / 2]))


def _ends(joint: Joint) -> FloatArray:
    ends = np.concatenate(joint.stretches)
    along = ends @ (ends[-1] - ends[0])
    return ends[[along.argmin(), along.argmax()]]

"""All that lies ready before the first step: parts, their outlines, how they move, flaps and where they land."""

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np

from popsim.assembly.flap_motion import FlapMotion, flap_motions
from popsim.assembly.outline import Outline
from popsim.assembly.reference import Reference
from popsim.assembly.scene import FlapKey
from popsim.design import GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.layout import Flap, Joint, Layout
from popsim.simulation import Sweep


class Kit:
    """A layout with the recorded motion of its design.

    Attributes
    ----------
    layout:
        What is put together.
    reference:
        The recorded motion by part.
    """

    def __init__(self, layout: Layout, sweep: Sweep) -> None:
        self.layout = layout
        self.reference = Reference(layout, sweep)

    @cached_property
    def outlines(self) -> dict[str, Outline]:
        """Outlines of all parts, by id."""
        return {name: Outline.of(part) for name, part in self.layout.parts.items()}

    @cached_property
    def joints(self) -> dict[str, Joint]:
        """All joints by id."""
        return {joint.id: joint for joint in self.layout.joints}

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

    def ground(self, parts: Iterable[str]) -> str | None:
        """The part of the ground among some parts, the first where it is divided; None where it is not there."""
        return min((name for name in parts if self.layout.parts[name].patch.id == GROUND_ID), default=None)

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

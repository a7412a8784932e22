"""Executing a step with things held open as in the finished pop-up, and pressed by closing it or by fingers."""

from collections.abc import Iterator

import numpy as np

from popsim import wording
from popsim.assembly.bundle import Bundle
from popsim.assembly.glueing import Glueing, Poses
from popsim.assembly.kit import ONE_LINE
from popsim.assembly.passage import Passage
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.reference import NEARLY_FLAT
from popsim.assembly.scene import flap_key
from popsim.assembly.stack import Stack
from popsim.assembly.trial import LOOK
from popsim.assembly.way import Way
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane, line_distance

OPENED = (180.0, 120.0, 75.0)
"""Degrees; fold angles at which glue is put into what is closed then."""

HELD = (180.0, 120.0, 75.0, 40.0)
"""Degrees; fold angles at which things are held for fingers to get at them."""

SIDES = (
    *((0, 0, 1), (1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1)),
    *((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -1)),
)
"""Directions from which something is brought to a face, in a frame whose last axis leads out of it."""


class Holding:
    """A bundle of which one joint is to be undone while it is held open."""

    def __init__(self, bundle: Bundle, name: str) -> None:
        self.bundle, self.name = bundle, name
        self.kit = bundle.kit
        self.left = bundle.without((name,))
        self.groups = self.left.groups(self.left.parts)
        self._glueing = Glueing(self.kit, (name,))
        self._flap = self._glueing.flaps[0]

    def closed(self) -> Proof | Refusal:
        """The joint is glued with all open, and pressed as all is folded flat: the rest guides it to its place."""
        if len(self.groups) > 1:
            return Refusal((self.name,), wording.NOT_GUIDED)
        degrees = self._opened
        if degrees is None:
            return Refusal((self.name,), wording.NO_GLUE)
        motion = self._closing(degrees)
        up = self._glueing.face(self._flap, {part: poses[-1] for part, poses in motion.items()})
        blind = self._glueing.covered(self._at(degrees))
        return Proof(Way.CLOSED, (self.name,), blind, motion, _moving(motion), up, (self.left,), degrees)

    @property
    def _opened(self) -> float | None:
        """The first of OPENED at which glue gets to the joint; what else is glued does not matter for that."""
        known, key = self.kit.opened, (self.name, self.bundle.parts)
        if key not in known:
            gets = (degrees for degrees in OPENED if self._glueing.gets_glue(self._at(degrees)))
            known[key] = next(gets, None)
        return known[key]

    def pressed(self) -> Proof | Refusal:
        """The joint is brought together and pressed between two fingers."""
        reason = ""
        for degrees in HELD:
            poses = self._at(degrees)
            unreached = self._glueing.unreached(poses)
            if unreached:
                reason = wording.NO_FINGER.format(carrier=unreached[0], target=unreached[1])
                continue
            apart = self._brought(poses)
            if apart is None:
                reason = wording.NO_SIDE_HELD.format(degrees=degrees)
                continue
            motion = {part: np.stack([apart[part], poses[part]]) for part in poses}
            blind = self._glueing.unseen(poses, apart)
            up = self._glueing.face(self._flap, poses)
            parts = tuple(self.left.only(group) for group in self.groups)
            return Proof(Way.HELD, (self.name,), blind, motion, _moving(motion), up, parts, degrees)
        return Refusal((self.name,), reason)

    def brought(self) -> Proof | Refusal:
        """What hangs on nothing else is brought to its place with all open, and pressed as all is folded flat."""
        if len(self.groups) == 1:
            return Refusal((self.name,), wording.NOT_TAKEN_AWAY)
        for degrees in HELD:
            poses = self._at(degrees)
            apart = self._brought(poses)
            if apart is None:
                continue
            closing = self._closing(degrees)
            table = {part: closing[part][0] @ np.linalg.inv(pose) for part, pose in poses.items()}
            motion = {part: np.concatenate([(table[part] @ apart[part])[None], closing[part]]) for part in poses}
            blind = self._glueing.unseen(poses, apart)
            up = self._glueing.face(self._flap, {part: own[-1] for part, own in motion.items()})
            parts = tuple(self.left.only(group) for group in self.groups)
            return Proof(Way.BROUGHT, (self.name,), blind, motion, _moving(motion), up, parts, degrees)
        return Refusal((self.name,), wording.NO_SIDE_OPEN)

    def tucked(self, stack: Stack) -> Proof | Refusal:
        """The flap is slid to its place between layers of what lies folded, from beyond its own crease."""
        folded = self.bundle.folded
        for flap in self._glueing.flaps:
            covers = stack.covers[flap_key(flap)] & folded.parts
            line = folded.axis(folded.joints[self.name])
            closed = [
                joint
                for joint in folded.joints.values()
                if joint.id != self.name and flap.target in joint.parts and not covers.isdisjoint(joint.parts)
            ]
            if any(line_distance(folded.axis(joint), line).max() < ONE_LINE for joint in closed):
                return Refusal((self.name,), wording.NO_MOUTH.format(target=flap.target))
            if all(side & folded.parts for side in stack.mouth(flap_key(flap))):
                return Refusal((self.name,), wording.SHUT_IN.format(carrier=flap.carrier))
        motion = {name: pose[None].repeat(2, axis=0) for name, pose in folded.poses.items()}
        up = self._glueing.face(self._flap, folded.poses)
        apart = tuple(self.left.only(group) for group in self.groups)
        return Proof(Way.TUCKED, (self.name,), (self.name,), motion, frozenset(), up, apart)

    def _brought(self, poses: Poses) -> Poses | None:
        """Where things are before they come together; None where there is no way."""
        if len(self.groups) == 1:
            return poses
        free = self.bundle.lighter(self.groups[0])
        held = self.bundle.held(poses)
        for direction in _around(self._glueing.face(self._flap, poses)):
            far = held.shifted(free, self.kit.size(poses) * direction)
            motion = {name: np.stack([far[name], poses[name]]) for name in poses}
            if not Passage(self.kit.outlines, motion).collisions(sorted(free), sorted(held.parts - free)):
                return held.shifted(free, LOOK * direction)
        return None

    def _closing(self, degrees: float) -> dict[str, FloatArray]:
        """How all is folded flat from an angle, the ground or the flap's target kept still, each (k, 4, 4)."""
        reference = self.kit.reference
        frames = slice(reference.frame(np.radians(degrees)), reference.frame(NEARLY_FLAT) + 1)
        still = self.kit.ground(self.bundle.poses) or self._flap.target
        back = np.linalg.inv(reference.poses[still][frames])
        return {part: back @ reference.poses[part][frames] for part in self.bundle.poses}

    def _at(self, degrees: float) -> dict[str, FloatArray]:
        whole = self.kit.reference.at(np.radians(degrees))
        return {name: whole[name] for name in self.bundle.poses}


def _moving(motion: Poses) -> frozenset[str]:
    return frozenset(part for part, poses in motion.items() if not np.allclose(poses[0], poses[-1], atol=1e-6))


def _around(up: FloatArray) -> Iterator[FloatArray]:
    """Directions to come from, `up` first; unit, (3,)."""
    plane = Plane.facing(up, np.zeros(3))
    for right, forward, rise in SIDES:
        direction = right * plane.u + forward * plane.v + rise * up
        yield direction / np.linalg.norm(direction)

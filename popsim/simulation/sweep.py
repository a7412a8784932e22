"""Closing the card and opening it again."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.design import Design, Hinge
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.frame import OPEN
from popsim.simulation.hull import Corners
from popsim.simulation.kinematics import chain_poses
from popsim.simulation.neighbours import companions, hinge_lines, touching
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.schedule import schedule_of
from popsim.simulation.solver import Pacing
from popsim.simulation.turning import turnings

PRESS_STEPS = 20
"""Steps at the closed card in which the pages press on what lies between them."""

TORN = 1e3
"""rad; a joint that turned farther than this was flung about by loops that cannot close."""

END = 1e-9
"""rad; nearer to 180 or 0 degrees than this the card is open or closed."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """The recorded motion of a design.

    Attributes
    ----------
    design:
        What was folded.
    theta:
        Recorded fold angles, rad: from open to closed to open, shape (n,).
    poses:
        Motion of each patch from the open pose at each of them, in the order of the design, shape (n, p, 4, 4).
    states:
        MuJoCo's joint positions at each of them, shape (n, q).
    complete:
        False where the integration broke down; then angles and poses end before that.
    """

    design: Design
    theta: FloatArray
    poses: FloatArray
    states: FloatArray
    complete: bool

    @cached_property
    def index(self) -> dict[str, int]:
        """Position of each patch in the design, by id."""
        return {patch.id: position for position, patch in enumerate(self.design.patches)}

    @cached_property
    def corners(self) -> Corners:
        """Corners of the convex hulls of the patches, in the order of the design."""
        return Corners(self.design.patches)

    @cached_property
    def places(self) -> FloatArray:
        """Where these corners are at each recorded angle, shape (n, v, 3)."""
        return self.corners.moved(self.poses)

    @cached_property
    def touching(self) -> BoolArray:
        """Pairs of patches that meet on a hinge line for ever, shape (p, p)."""
        return touching(self.design, self._lines)

    @cached_property
    def companions(self) -> tuple[Hinge, ...]:
        """Patches that turn about one line and share no hinge, as hinges."""
        return companions(self.design, self._lines)

    @cached_property
    def _lines(self) -> list[list[Hinge]]:
        return hinge_lines(self.design)

    def turned(self, hinges: Sequence[Hinge]) -> FloatArray:
        """How far the patches of hinges have turned at each recorded angle, rad, shape (n, h); asked once each."""
        new = [hinge for hinge in hinges if hinge.id not in self._turned]
        if new:
            first, second = (self.poses[:, [self.index[hinge.patches[side]] for hinge in new]] for side in (0, 1))
            found = turnings(new, first, second)
            self._turned.update(zip([hinge.id for hinge in new], found.T, strict=True))
        return np.stack([self._turned[hinge.id] for hinge in hinges], axis=1)

    @cached_property
    def _turned(self) -> dict[str, FloatArray]:
        """Turning of the hinges that were asked for, by their ids, shape (n,) each."""
        return {}

    @property
    def hulls(self) -> tuple[FloatArray, ...]:
        """The same in the open pose, patch by patch, each (k, 3)."""
        return self.corners.hulls

    @property
    def degrees(self) -> FloatArray:
        """Recorded fold angles in degrees, shape (n,)."""
        return np.degrees(self.theta)

    @property
    def closed(self) -> int:
        """Position of the closed card among the angles (the least angle that was reached)."""
        return int(np.argmin(self.theta))

    def closing_at(self, degrees: Iterable[float]) -> list[int]:
        """Recorded closing angles nearest to `degrees`, each once; never the open or the closed card."""
        theta = self.theta[: self.closed + 1]
        inside = np.flatnonzero((theta > END) & (theta < OPEN - END))
        if not len(inside):
            return []
        return sorted({int(inside[np.abs(theta[inside] - np.radians(angle)).argmin()]) for angle in degrees})

    def moved(self, patch: str, count: int | None = None) -> FloatArray:
        """Hull corners of a patch at the first `count` angles (at all), shape (n, k, 3)."""
        return self.places[:count, self.corners.spans[self.index[patch]]]


def fold(rig: Rig, count: int, pacing: Pacing) -> Sweep:
    """Close and open the card.

    Parameters
    ----------
    rig:
        The design in MuJoCo, as built: fully open.
    count:
        Recorded angles each way.
    pacing:
        How slowly, and when to break off.
    """
    schedule = schedule_of(count, pacing)
    turns = page_quaternions(schedule.driven)
    rig.settle(schedule.settle_steps[0])
    states = [rig.state()]
    driven, closed = 0, len(schedule.leg_steps) // 2 - 1
    for leg, (steps, rest) in enumerate(zip(schedule.leg_steps, schedule.settle_steps[1:], strict=True)):
        for turn in turns[driven : driven + steps]:
            rig.hold(turn)
            rig.step()
        driven += steps
        if leg == closed:
            rig.press(PRESS_STEPS)
        rig.settle(rest)
        if rest and pacing.hopeless < np.inf and rig.strain() > pacing.hopeless:
            break
        if schedule.is_recorded[leg + 1]:
            states.append(rig.state())
            if not _sound(states[-1]):
                break
    return _recorded(rig, schedule.recorded, np.array(states))


def _sound(state: FloatArray) -> bool:
    """Whether joint positions (q,) are numbers, and not those of plates that were flung about."""
    return bool(np.abs(state).max(initial=0.0) < TORN)


def _recorded(rig: Rig, theta: FloatArray, states: FloatArray) -> Sweep:
    """The sweep up to the last sound one of states (k, q); all but the last are."""
    count = len(states) if _sound(states[-1]) else len(states) - 1
    complete = count == len(theta)
    theta, states = theta[:count], states[:count]
    poses = chain_poses(rig, theta, states[:, rig.joint_order])
    return Sweep(rig.design, theta, poses, states, complete)

"""Whether anything moves while the pages are held (Sec. 3.1).

**Free motions** are counted at first order, by the nullity of the loop equations, well away from the flat poses:
at 180 and 0 degrees their Jacobian drops rank although the structure is rigid to second order, and one that is
loose may lie flat before the card does. **Near the flat poses** the finite test alone decides: all patches are
pushed, and what moves farther than a structure may is loose.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, locked
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.sweep import Sweep

SINGULAR = 1e-5
"""Gap per motion below which a motion counts as free. Free motions of exact designs are found at 1e-15, the least
stiff motion of a sound one at 1e-3 one degree from closed."""

JACOBIAN_DEGREES = tuple(range(150, 20, -10))
"""Where free motions are counted. Nearer to the flat poses the number for a loose structure is chance: it may hang
in a pose that is singular itself."""

PUSH_DEGREES = (178, 120, 60, 2)
"""Where the structure is pushed: also near the ends, where only a finite test tells."""

PUSHES = ((25, 8), (100, 20), (400, 80))
"""Steps for which the wrench acts, and steps after its release, from hard and short to gentle and long; each
wrench would carry a free plate equally far. What resists a harder one needs no gentler one. What gives way may be
free, and goes as far under a gentler one, or soft, and resists it."""

PUSH_MOTION = 0.3
"""How far the wrench would carry a free plate, of the size of the pop-up."""

SEED = 2014
"""The wrenches are random, but always the same."""


@dataclass(frozen=True)
class FreeMotions:
    """Free motions at one fold angle: their number, and gap per motion of the least stiff motion."""

    theta: float
    count: int
    stiffness: float


@dataclass(frozen=True)
class Push:
    """What random wrenches on all patches did at one fold angle.

    Attributes
    ----------
    theta:
        Fold angle, rad.
    moved:
        Greatest motion of any corner under the wrench, mm.
    left:
        What of it was left after release, mm.
    patch:
        The patch that moved most.
    """

    theta: float
    moved: float
    left: float
    patch: str


def free_motions(rig: Rig, sweep: Sweep, sound: BoolArray) -> list[FreeMotions]:
    """Count free motions in the closing poses nearest to JACOBIAN_DEGREES, of those that are `sound` (n,)."""
    frames = [frame for frame in sweep.closing_at(JACOBIAN_DEGREES) if sound[frame]]
    counts, least = rig.jacobian.nullity(sweep.poses[frames], SINGULAR)
    return [
        FreeMotions(float(sweep.theta[frame]), int(count), float(value))
        for frame, count, value in zip(frames, counts, least, strict=True)
    ]


def push_test(rig: Rig, sweep: Sweep, allowed: float) -> list[Push]:
    """Push all patches at the closing poses nearest to PUSH_DEGREES, release them, and measure.

    Ever more gently where anything moves, or is left, by more than `allowed` mm.
    """
    with rig.without_preloads():
        return [_gentlest(rig, sweep, frame, allowed) for frame in sweep.closing_at(PUSH_DEGREES)]


def _gentlest(rig: Rig, sweep: Sweep, frame: int, allowed: float) -> Push:
    """The first of PUSHES that is resisted, or the last."""
    for steps in PUSHES:
        push = _push(rig, sweep, frame, steps)
        if push.moved <= allowed and push.left <= allowed:
            break
    return push


def _push(rig: Rig, sweep: Sweep, frame: int, steps: tuple[int, int]) -> Push:
    theta = float(sweep.theta[frame])
    rig.restore(sweep.states[frame], page_quaternions(np.array(theta)))
    before = sweep.places[frame]

    def motions() -> FloatArray:
        """Greatest motion of any corner of each patch until now, mm, shape (p,)."""
        now = sweep.corners.moved(rig.poses()[None])
        return np.asarray(sweep.corners.greatest(np.linalg.norm(now - before, axis=-1))[0])

    rig.push(_wrenches(rig, steps[0]))
    rig.step(steps[0])
    moved = motions()
    rig.push(None)
    rig.step(steps[1])
    worst = int(moved.argmax())
    return Push(theta, float(moved[worst]), float(motions().max()), rig.design.patches[worst].id)


def _wrenches(rig: Rig, steps: int) -> FloatArray:
    """Random force and torque on each body that carry it PUSH_MOTION far, alone, shape (bodies, 6)."""
    acceleration = 2 * PUSH_MOTION / (steps * rig.model.opt.timestep) ** 2
    directions = _directions(rig.model.nbody)
    lever = np.sqrt(rig.model.body_inertia.max(axis=1) / np.maximum(rig.model.body_mass, 1e-12))
    force = acceleration * rig.model.body_mass[:, None] * directions[:, 0]
    torque = acceleration * (rig.model.body_mass * lever)[:, None] * directions[:, 1]
    return np.concatenate([force, torque], axis=1)


@lru_cache(maxsize=16)
def _directions(bodies: int) -> FloatArray:
    """Random unit vectors, always the same, shape (bodies, 2, 3)."""
    directions = np.random.default_rng(SEED).normal(size=(bodies, 2, 3))
    return locked(directions / np.linalg.norm(directions, axis=-1, keepdims=True), (None, 2, 3), "directions")

"""Whether anything moves while the pages are held (Sec. 3.1)."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.simulation.jacobian import LoopJacobian
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.sweep import Sweep

SINGULAR = 1e-5
"""Gap per motion below which a motion counts as free. Free motions of exact designs are found at 1e-15, the least
stiff motion of a sound one at 1e-3 one degree from closed."""

JACOBIAN_DEGREES = tuple(range(170, 0, -10))
"""Where free motions are counted: away from open and closed, where the Jacobian drops rank although the structure
is rigid to second order."""

PUSH_DEGREES = (178, 120, 60, 2)
"""Where the structure is pushed: also near the ends, where only a finite test tells."""

PUSH_STEPS = 100
"""Steps for which the wrench acts: long enough to tell a free motion, which grows with the square of the time,
from a soft one, which comes to rest."""

RELEASE_STEPS = 20
"""Steps after its release."""

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


def free_motions(rig: Rig, sweep: Sweep) -> list[FreeMotions]:
    """Count free motions in the closing poses nearest to JACOBIAN_DEGREES."""
    frames = sweep.closing_at(JACOBIAN_DEGREES)
    jacobian = LoopJacobian(rig.design, rig.forest)
    counts, least = jacobian.nullity(sweep.poses[frames], SINGULAR)
    return [
        FreeMotions(float(sweep.theta[frame]), int(count), float(value))
        for frame, count, value in zip(frames, counts, least, strict=True)
    ]


def push_test(rig: Rig, sweep: Sweep) -> list[Push]:
    """Push all patches at the closing poses nearest to PUSH_DEGREES, release them, and measure."""
    random = np.random.default_rng(SEED)
    with rig.without_preloads():
        return [_push(rig, sweep, frame, random) for frame in sweep.closing_at(PUSH_DEGREES)]


def _push(rig: Rig, sweep: Sweep, frame: int, random: np.random.Generator) -> Push:
    theta = float(sweep.theta[frame])
    rig.restore(sweep.states[frame], page_quaternions(np.array(theta)))
    before = _corners(rig)
    rig.push(_wrenches(rig, random))
    rig.step(PUSH_STEPS)
    moved = _corners(rig)
    rig.push(None)
    rig.step(RELEASE_STEPS)
    left = _corners(rig)
    shifts = [float(np.linalg.norm(now - then, axis=-1).max()) for now, then in zip(moved, before, strict=True)]
    rest = [float(np.linalg.norm(now - then, axis=-1).max()) for now, then in zip(left, before, strict=True)]
    worst = int(np.argmax(shifts))
    return Push(theta, shifts[worst], max(rest), rig.design.patches[worst].id)


def _wrenches(rig: Rig, random: np.random.Generator) -> FloatArray:
    """Random force and torque on each body that carry it PUSH_MOTION far, alone, shape (bodies, 6)."""
    duration = PUSH_STEPS * rig.model.opt.timestep
    acceleration = 2 * PUSH_MOTION / duration**2
    directions = random.normal(size=(rig.model.nbody, 2, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    lever = np.sqrt(rig.model.body_inertia.max(axis=1) / np.maximum(rig.model.body_mass, 1e-12))
    force = acceleration * rig.model.body_mass[:, None] * directions[:, 0]
    torque = acceleration * (rig.model.body_mass * lever)[:, None] * directions[:, 1]
    return np.concatenate([force, torque], axis=1)


def _corners(rig: Rig) -> list[FloatArray]:
    """Corners of each patch where it is now, mm."""
    return [
        patch.points @ pose[:3, :3].T + pose[:3, 3]
        for patch, pose in zip(rig.design.patches, rig.poses(), strict=True)
    ]

"""Taking off what the integration left of a loop gap.

MuJoCo enforces at most 0.9999 of a constraint, so near the open and the closed card, where a structure is soft to
first order, a few steps leave plates off their place although the gap is tiny. A few Levenberg-Marquardt steps on
the loop equations, from the recorded joint angles and within their limits, close it. They cannot hide that a
design does not fold: a pose is replaced only where its measured gap becomes smaller, and poses with a gap beyond
NEAR are left as they are.
"""

from dataclasses import replace

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.gaps import loop_gaps
from popsim.simulation.jacobian import Group, LoopJacobian
from popsim.simulation.kinematics import chain_poses
from popsim.simulation.rig import Rig
from popsim.simulation.sweep import Sweep

NEAR = 0.05
"""mm; poses with a greater gap are no solutions to begin with."""

DONE = 1e-10
"""Gap over the size of the pop-up that needs no polish."""

FLOOR = 1e-13
"""Least damping: above rounding, below every stiffness that counts."""

STEPS = 40
"""Most Levenberg-Marquardt steps; most poses need three."""


def polished(rig: Rig, sweep: Sweep) -> Sweep:
    """Return `sweep` with the gaps of nearly closed loops closed as far as they can be."""
    if not rig.forest.loops:
        return sweep
    before = loop_gaps(sweep, rig.forest.loops).by_angle
    return _polished(rig, sweep, before, np.flatnonzero((before > DONE * rig.scale) & (before < NEAR)))


def inserted(rig: Rig, sweep: Sweep, after: int, parts: int) -> Sweep:
    """Return `sweep` with `parts - 1` more angles between the recorded ones `after` and `after + 1`.

    Joint angles between two recorded ones lie on a straight line first; then the loops are closed.
    """
    share = np.arange(1, parts)[:, None] / parts
    states = sweep.states[after] * (1 - share) + sweep.states[after + 1] * share
    theta = sweep.theta[after] * (1 - share[:, 0]) + sweep.theta[after + 1] * share[:, 0]
    new = np.arange(after + 1, after + parts)
    poses = chain_poses(rig, theta, states[:, rig.joint_order])
    finer = replace(
        sweep,
        theta=np.insert(sweep.theta, after + 1, theta),
        poses=np.insert(sweep.poses, [after + 1], poses, axis=0),
        states=np.insert(sweep.states, [after + 1], states, axis=0),
    )
    return _polished(rig, finer, loop_gaps(finer, rig.forest.loops).by_angle, new) if rig.forest.loops else finer


def _polished(rig: Rig, sweep: Sweep, before: FloatArray, frames: IntArray) -> Sweep:
    """Polish the poses at some angles (k,), where the gaps `before` (n,) become smaller."""
    if not len(frames):
        return sweep
    theta = sweep.theta[frames]
    angles = _improve(rig, theta, sweep.states[frames][:, rig.joint_order])
    poses = chain_poses(rig, theta, angles)
    after = loop_gaps(replace(sweep, theta=theta, poses=poses), rig.forest.loops).by_angle
    better = after < before[frames]
    all_poses, states = sweep.poses.copy(), sweep.states.copy()
    all_poses[frames[better]] = poses[better]
    states[np.ix_(frames[better], rig.joint_order)] = angles[better]
    return replace(sweep, poses=all_poses, states=states)


def _improve(rig: Rig, theta: FloatArray, angles: FloatArray) -> FloatArray:
    """Joint angles with the loops closed, or after STEPS steps, shape (n, j)."""
    jacobian = LoopJacobian(rig.design, rig.forest)
    axes = np.array([joint.hinge.points[1] - joint.hinge.points[0] for joint in rig.forest.joints])
    scale = np.sign((axes * rig.joint_axes).sum(axis=1)) / jacobian.reach
    lower, upper = rig.joint_limits
    everything = list(range(len(rig.forest.loops)))
    angles, left = angles.copy(), np.arange(len(theta))
    for _ in range(STEPS):
        poses = chain_poses(rig, theta[left], angles[left])
        open_still = np.abs(jacobian.residual(poses, everything)).max(axis=1) > DONE * rig.scale
        left, poses = left[open_still], poses[open_still]
        if not len(left):
            break
        for group in jacobian.groups:
            if group.loops:
                step = _step(jacobian, poses, group, rig.scale)
                angles[np.ix_(left, group.columns)] += step * scale[group.columns]
        angles[left] = np.clip(angles[left], lower, upper)
    return angles


def _step(jacobian: LoopJacobian, poses: FloatArray, group: Group, size: float) -> FloatArray:
    """Step of the joints of one group, in mm at the far end of their patches, shape (n, c).

    Damping in proportion to the gap keeps the convergence fast where the Jacobian drops rank.
    """
    matrix = jacobian.matrix(poses, group)
    gap = jacobian.residual(poses, group.loops)
    damping = np.linalg.norm(gap, axis=1) / size
    across = np.swapaxes(matrix, 1, 2)
    normal = across @ matrix + (damping + FLOOR)[:, None, None] * np.eye(len(group.columns))
    return np.asarray(-np.linalg.solve(normal, across @ gap[..., None])[..., 0])

"""Taking off what the integration left of a loop gap.

MuJoCo enforces at most 0.9999 of a constraint, so near the open and the closed card, where a structure is soft to
first order, a few steps leave plates off their place although the gap is tiny. A few Levenberg-Marquardt steps on
the loop equations, from the recorded joint angles and within their limits, close it. They cannot hide that a
design does not fold: a pose is replaced only where its measured gap becomes smaller, and where more than NEAR was
left, only if its loops close. How plates share a greater gap among their hinges is what the integration found.
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
"""mm; poses with a greater gap are left as they are, unless their loops can be closed."""

FAR = 0.01
"""Gap over the size of the pop-up beyond which a pose is no solution to begin with."""

CLOSED = 1e-8
"""Gap over the size of the pop-up with which loops are closed."""

DONE = 1e-10
"""Gap over the size of the pop-up that needs no polish."""

FLOOR = 1e-13
"""Least damping: above rounding, below every stiffness that counts."""

BOLDER, MORE_CAREFUL = 0.1, 20.0
"""Factors on the damping after a step that made the gap smaller, and after one that did not and is undone."""

STEPS = 40
"""Most Levenberg-Marquardt steps; most poses need three."""


def polished(rig: Rig, sweep: Sweep) -> Sweep:
    """Return `sweep` with the gaps of nearly closed loops closed as far as they can be."""
    if not rig.forest.loops:
        return sweep
    before = loop_gaps(sweep, rig.forest.loops).by_angle
    return _polished(rig, sweep, before, np.flatnonzero((before > DONE * rig.scale) & (before < FAR * rig.scale)))


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
    better = after < np.where(before[frames] < NEAR, before[frames], CLOSED * rig.scale)
    all_poses, states = sweep.poses.copy(), sweep.states.copy()
    all_poses[frames[better]] = poses[better]
    states[np.ix_(frames[better], rig.joint_order)] = angles[better]
    return replace(sweep, poses=all_poses, states=states)


def _improve(rig: Rig, theta: FloatArray, angles: FloatArray) -> FloatArray:
    """Joint angles with the loops closed, or the best after STEPS steps, shape (n, j)."""
    jacobian = LoopJacobian(rig.design, rig.forest)
    axes = np.array([joint.hinge.points[1] - joint.hinge.points[0] for joint in rig.forest.joints])
    scale = np.sign((axes * rig.joint_axes).sum(axis=1)) / jacobian.reach
    everything = list(range(len(rig.forest.loops)))
    best, gaps, caution = angles.copy(), np.full(len(theta), np.inf), np.ones(len(theta))
    poses = np.empty((len(theta), len(rig.design.patches), 4, 4))
    left = np.arange(len(theta))
    for _ in range(STEPS):
        tried = chain_poses(rig, theta[left], angles[left])
        found = np.abs(jacobian.residual(tried, everything)).max(axis=1)
        better = found < gaps[left]
        gained = left[better]
        best[gained], gaps[gained], poses[gained] = angles[gained], found[better], tried[better]
        caution[left] *= np.where(better, BOLDER, MORE_CAREFUL)
        left = left[gaps[left] > DONE * rig.scale]
        if not len(left):
            break
        angles[left] = best[left]
        for group in jacobian.groups:
            if group.loops:
                step = _step(jacobian, poses[left], group, caution[left] / rig.scale)
                angles[left[:, None], group.columns] += step * scale[group.columns]
        angles[left] = np.clip(angles[left], *rig.joint_limits)
    return best


def _step(jacobian: LoopJacobian, poses: FloatArray, group: Group, caution: FloatArray) -> FloatArray:
    """Step of the joints of one group, in mm at the far end of their patches, shape (n, c).

    Damping is `caution` (n,), 1/mm, times the gap: that keeps the convergence fast where the Jacobian drops rank.
    """
    matrix = jacobian.matrix(poses, group)
    gap = jacobian.residual(poses, group.loops)
    damping = caution * np.linalg.norm(gap, axis=1) + FLOOR
    across = np.swapaxes(matrix, 1, 2)
    normal = across @ matrix + damping[:, None, None] * np.eye(len(group.columns))
    return np.asarray(-np.linalg.solve(normal, across @ gap[..., None])[..., 0])

"""Taking off what the integration left of a loop gap.

MuJoCo enforces at most 0.9999 of a constraint, so near the open and the closed card, where a structure is soft to
first order, a few steps leave plates off their place although the gap is tiny. A few Levenberg-Marquardt steps on
the loop equations, from the recorded joint angles and within their limits, close it. They cannot hide that a
design does not fold: a pose is replaced only where its measured gap becomes smaller, and where more than NEAR was
left, only if its loops close. How plates share a greater gap among their hinges is what the integration found.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.gaps import loop_gaps
from popsim.simulation.jacobian import Group
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

PATIENCE = 6
"""Steps in which a gap must become half of what it was, or it is left: where loops close, every step but one that
is undone does as much, even near flat poses."""


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
    angles, poses = _improve(rig, theta, sweep.states[frames][:, rig.joint_order], sweep.poses[frames])
    after = loop_gaps(replace(sweep, theta=theta, poses=poses), rig.forest.loops).by_angle
    better = after < np.where(before[frames] < NEAR, before[frames], CLOSED * rig.scale)
    all_poses, states = sweep.poses.copy(), sweep.states.copy()
    all_poses[frames[better]] = poses[better]
    states[np.ix_(frames[better], rig.joint_order)] = angles[better]
    return replace(sweep, poses=all_poses, states=states)


def _improve(
    rig: Rig, theta: FloatArray, angles: FloatArray, started: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Joint angles (n, j) with the loops closed, or the best that were found, and their poses (n, p, 4, 4).

    `started` are those of the angles that are given. Each group of loops goes its own way: its gap answers to its
    own joints alone.
    """
    jacobian = rig.jacobian
    axes = np.array([joint.hinge.points[1] - joint.hinge.points[0] for joint in rig.forest.joints])
    scale = np.sign((axes * rig.joint_axes).sum(axis=1)) / jacobian.reach
    search = _Search(angles, [group for group in jacobian.groups if group.loops], DONE * rig.scale)
    best = started.copy()
    for number in range(STEPS):
        frames = search.frames
        if not len(frames):
            break
        poses = chain_poses(rig, theta[frames], search.tried[frames]) if number else best[frames]
        residual = jacobian.residual(poses)
        undone = search.take(frames, residual)
        poses[undone] = chain_poses(rig, theta[frames[undone]], search.tried[frames[undone]])
        residual[undone] = jacobian.residual(poses[undone])
        best[frames] = poses
        if number % PATIENCE == 0:
            search.give_up()
        for rows, place, group in search.open_groups(frames):
            matrix, gap = jacobian.matrix(poses[rows], group), residual[rows][:, group.loops]
            step = _step(matrix, gap.reshape(len(rows), -1), search.caution[frames[rows], place] / rig.scale)
            search.tried[frames[rows, None], group.columns] += step * scale[group.columns]
        search.tried = np.clip(search.tried, *rig.joint_limits)
    return search.best, best


class _Search:
    """Joint angles of all frames, (n, j), and how far each of the groups (g) has come.

    Attributes
    ----------
    best, tried:
        Angles with the smallest gaps so far, and those to be tried next, rad.
    gaps, caution:
        Largest gap of each group in mm, and the damping of its next step, shape (n, g).
    """

    def __init__(self, angles: FloatArray, groups: list[Group], done: float) -> None:
        self.best, self.tried = angles.copy(), angles.copy()
        shape = (len(angles), len(groups))
        self.gaps, self.caution = np.full(shape, np.inf), np.ones(shape)
        self._earlier = np.full(shape, np.inf)
        self._left = np.ones(shape, dtype=bool)
        self._groups, self._done = groups, done

    @property
    def frames(self) -> IntArray:
        """Positions of the frames in which something is left to close, shape (k,)."""
        return np.flatnonzero(self._left.any(axis=1))

    def take(self, frames: IntArray, residual: FloatArray) -> IntArray:
        """Keep what was tried in frames (k,) where its residual (k, l, 6) is smaller, and undo the rest.

        Returns the rows of those in which anything was undone.
        """
        found = np.stack([np.abs(residual[:, group.loops]).max(axis=(1, 2)) for group in self._groups], axis=1)
        left = self._left[frames]
        better = left & (found < self.gaps[frames])
        for place, group in enumerate(self._groups):
            gained = np.ix_(frames[better[:, place]], np.array(group.columns))
            self.best[gained] = self.tried[gained]
        self.tried[frames] = self.best[frames]
        self.gaps[frames] = np.where(better, found, self.gaps[frames])
        self.caution[frames] *= np.where(better, BOLDER, MORE_CAREFUL)
        self._left &= self.gaps > self._done
        return np.flatnonzero((left & ~better).any(axis=1))

    def give_up(self) -> None:
        """Leave groups whose gap is more than half of what it was when this was last asked."""
        self._left &= self.gaps < self._earlier / 2
        self._earlier = self.gaps.copy()

    def open_groups(self, frames: IntArray) -> Iterator[tuple[IntArray, int, Group]]:
        """Each group with its place, and the rows of frames (k,) in which it is left to close."""
        for place, group in enumerate(self._groups):
            rows = np.flatnonzero(self._left[frames, place])
            if len(rows):
                yield rows, place, group


def _step(matrix: FloatArray, gap: FloatArray, caution: FloatArray) -> FloatArray:
    """Step of the joints of one group, in mm at the far end of their patches, shape (n, c).

    From its matrix (n, r, c) and gap (n, r). Damping is `caution` (n,), 1/mm, times the gap: that keeps the
    convergence fast where the Jacobian drops rank.
    """
    damping = caution * np.linalg.norm(gap, axis=1) + FLOOR
    across = np.swapaxes(matrix, 1, 2)
    normal = across @ matrix + damping[:, None, None] * np.eye(matrix.shape[2])
    return np.asarray(-np.linalg.solve(normal, across @ gap[..., None])[..., 0])

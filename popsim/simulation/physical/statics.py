"""Forces in a pop-up at rest."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.forest import PAGES, Forest
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.sweep import Sweep

SETTLE = 16
"""Steps from rest: what is then out of balance is below a millionth of the moments, a degree from flat below a
hundred thousandth."""

EQUALITY = 0
"""MuJoCo's number for constraint forces of equalities (mjCNSTR_EQUALITY)."""


@dataclass(frozen=True, eq=False)
class Balance:
    """Forces at one recorded angle.

    Attributes
    ----------
    torque:
        What a hand must turn the backdrop with about the central fold to hold it there, N mm; positive towards
        closing.
    unbalanced:
        Greatest moment about the axis of any joint that nothing holds, N mm: how far from rest it was measured.
    forces:
        Of each hinge but the central one on its first patch, N, shape (3,), by its id; its second patch feels the
        opposite.
    """

    torque: float
    unbalanced: float
    forces: dict[str, FloatArray]


def balance(rig: Rig, sweep: Sweep, frame: int, wrenches: FloatArray) -> Balance:
    """Let the pop-up carry `wrenches` with its pages held, and measure.

    Where a loop has play, its ends are joined as they are, half-way between them: what the paper gives way with is
    not known, so no force of it is counted.

    Parameters
    ----------
    rig, sweep, frame:
        What was folded, and the recorded angle, strictly between open and closed. Preloads of creases are expected
        to be off.
    wrenches:
        Force and moment about the origin of the card frame on each patch, N and N mm, shape (p, 6).
    """
    unit = float(np.abs(wrenches * ([1.0] * 3 + [1 / rig.scale] * 3)).max()) or 1.0
    middles = _middles(sweep, rig.forest, frame)
    rig.restore(sweep.states[frame], page_quaternions(np.array(sweep.theta[frame])))
    with _joined(rig, sweep, frame, middles):
        rig.load(wrenches / unit)
        rig.settle(SETTLE)
        forces = _loop_forces(rig) * unit
        rig.push(None)
    return _carried(sweep, rig.forest, frame, wrenches, middles, forces)


def _middles(sweep: Sweep, forest: Forest, frame: int) -> FloatArray:
    """Half-way between the two images of both ends of each loop hinge, mm, shape (l, 2, 3)."""
    poses = [[sweep.poses[frame, sweep.index[name]] for name in hinge.patches] for hinge in forest.loops]
    points = np.array([hinge.points for hinge in forest.loops]).reshape(-1, 1, 2, 3)
    return np.asarray(transform(np.array(poses).reshape(-1, 2, 4, 4), points).mean(axis=1))


@contextmanager
def _joined(rig: Rig, sweep: Sweep, frame: int, middles: FloatArray) -> Iterator[None]:
    """Move the ends of all loops on their patches to where `middles` says, and take joint limits off, for a while.

    A recorded pose may lie a little beyond a limit, where it would be pushed back: there, too, paper gives way.
    """
    anchors, limited = rig.model.eq_data.copy(), rig.model.jnt_limited.copy()
    rig.model.jnt_limited[:] = 0
    for side in (0, 1):
        poses = np.array([sweep.poses[frame, sweep.index[hinge.patches[side]]] for hinge in rig.forest.loops])
        turns, shifts = poses.reshape(-1, 4, 4)[:, :3, :3], poses.reshape(-1, 4, 4)[:, None, :3, 3]
        rig.model.eq_data[:, 3 * side : 3 * side + 3] = ((middles - shifts) @ turns).reshape(-1, 3) / rig.scale
    try:
        yield
    finally:
        rig.model.eq_data[:], rig.model.jnt_limited[:] = anchors, limited


def _loop_forces(rig: Rig) -> FloatArray:
    """Force on the first patch at both ends of each loop hinge, units of the model, shape (l, 2, 3).

    Ends that no joint of the forest can move are no constraint to MuJoCo; their force is 0.
    """
    forces = np.zeros((2 * len(rig.forest.loops), 3))
    rows = rig.data.efc_type == EQUALITY
    ends, measured = rig.data.efc_id[rows], rig.data.efc_force[rows]
    forces[ends[::3]] = measured.reshape(-1, 3)
    return forces.reshape(-1, 2, 3)


def _carried(
    sweep: Sweep, forest: Forest, frame: int, wrenches: FloatArray, middles: FloatArray, ends: FloatArray
) -> Balance:
    """Carry loads and loop forces through the joints, from the outermost patches to the pages."""
    total = {patch.id: wrench.copy() for patch, wrench in zip(sweep.design.patches, wrenches, strict=True)}
    forces: dict[str, FloatArray] = {}
    for hinge, places, pair in zip(forest.loops, middles, ends, strict=True):
        forces[hinge.id] = pair.sum(axis=0)
        for sign, name in zip((1, -1), hinge.patches, strict=True):
            total[name][:3] += sign * forces[hinge.id]
            total[name][3:] += sign * np.cross(places, pair).sum(axis=0)
    unbalanced = 0.0
    for joint in reversed(forest.joints):
        wrench = total[joint.child]
        places = transform(sweep.poses[frame, sweep.index[joint.child]], joint.hinge.points)
        axis = (places[1] - places[0]) / joint.hinge.length
        unbalanced = max(unbalanced, abs(float(axis @ (wrench[3:] - np.cross(places[0], wrench[:3])))))
        total[joint.parent] += wrench
        forces[joint.hinge.id] = wrench[:3] if joint.hinge.patches[0] == joint.parent else -wrench[:3]
    return Balance(float(total[PAGES[1]][3]), unbalanced, forces)

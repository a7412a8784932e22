"""Poses of all patches from the angles of the joints."""

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import Side, page_poses
from popsim.simulation.forest import PAGES
from popsim.simulation.rig import Rig


def chain_poses(rig: Rig, theta: FloatArray, angles: FloatArray) -> FloatArray:
    """Motion of each patch from the open pose, shape (n, p, 4, 4).

    Parameters
    ----------
    rig:
        Gives the forest and the axes.
    theta:
        Fold angles, rad, shape (n,).
    angles:
        Angle of each joint of the forest, rad, in its order, shape (n, j).
    """
    place = {patch.id: index for index, patch in enumerate(rig.design.patches)}
    poses = np.zeros((len(theta), len(place), 4, 4))
    for page, side in zip(PAGES, (Side.GROUND, Side.BACKDROP), strict=True):
        poses[:, place[page]] = page_poses(side, theta)
    for index, joint in enumerate(rig.forest.joints):
        turn = _turns(rig.joint_axes[index], joint.hinge.points[0], angles[:, index])
        poses[:, place[joint.child]] = poses[:, place[joint.parent]] @ turn
    return poses


def _turns(axis: FloatArray, point: FloatArray, angles: FloatArray) -> FloatArray:
    """Rotations about an axis through a point (Rodrigues), shape (n, 4, 4)."""
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sine, versine = np.sin(angles)[:, None, None], 2 * np.sin(angles / 2)[:, None, None] ** 2
    turns = np.zeros((len(angles), 4, 4))
    turns[:, :3, :3] = np.eye(3) + sine * skew + versine * (skew @ skew)
    turns[:, :3, 3] = point - turns[:, :3, :3] @ point
    turns[:, 3, 3] = 1
    return turns

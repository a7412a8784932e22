"""Poses of all patches from the angles of the joints."""

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import Side, page_poses
from popsim.geometry.rigid import turns_about
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
        turn = turns_about(rig.joint_axes[index], joint.hinge.points[0], angles[:, index])
        poses[:, place[joint.child]] = poses[:, place[joint.parent]] @ turn
    return poses

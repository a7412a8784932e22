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
    joints = rig.forest.joints
    place = {patch.id: index for index, patch in enumerate(rig.design.patches)}
    poses = np.zeros((len(theta), len(place), 4, 4))
    for page, side in zip(PAGES, (Side.GROUND, Side.BACKDROP), strict=True):
        poses[:, place[page]] = page_poses(side, theta)
    if not joints:
        return poses
    points = np.array([joint.hinge.points[0] for joint in joints])
    turns = turns_about(rig.joint_axes, points, angles)
    for level in rig.forest.levels:
        children, parents = (
            [place[name] for name in names]
            for names in zip(*((joints[k].child, joints[k].parent) for k in level), strict=True)
        )
        poses[:, children] = poses[:, parents] @ turns[:, level]
    return poses

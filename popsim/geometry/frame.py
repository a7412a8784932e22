"""The card frame as a function of the fold angle."""

from enum import Enum

import numpy as np

from popsim.geometry.arrays import FloatArray, locked

OPEN = np.pi
"""Fold angle of the fully open card, radians."""

X_AXIS, Y_AXIS, Z_AXIS = (locked(axis, (3,), "axis") for axis in np.eye(3))
MINUS_X, MINUS_Y, MINUS_Z = (locked(-axis, (3,), "axis") for axis in (X_AXIS, Y_AXIS, Z_AXIS))


class Side(Enum):
    """On which page something lies; the value is the sign of y in the open pose."""

    GROUND = 1
    BACKDROP = -1

    @property
    def other(self) -> "Side":
        """The opposite side."""
        return Side(-self.value)


def page_direction(side: Side, theta: FloatArray) -> FloatArray:
    """Unit direction in the page, away from the fold: g or b of Sec. 3.3.2, shape (n, 3)."""
    alpha = np.asarray(theta, float) / 2
    return np.stack([np.zeros_like(alpha), side.value * np.sin(alpha), np.cos(alpha)], axis=-1)


def skew_point(x: float, u: float, v: float, side: Side, theta: FloatArray) -> FloatArray:
    """Point x e_x + u d + v z at each fold angle, shape (n, 3)."""
    return np.array([x, 0.0, v]) + u * page_direction(side, theta)


def page_poses(side: Side, theta: FloatArray) -> FloatArray:
    """Rigid motion of a page from the open pose to each fold angle, shape (n, 4, 4)."""
    turn = side.value * (OPEN - np.asarray(theta, float)) / 2
    poses = np.zeros((len(turn), 4, 4))
    poses[:, 0, 0] = poses[:, 3, 3] = 1
    poses[:, 1, 1] = poses[:, 2, 2] = np.cos(turn)
    poses[:, 1, 2] = -np.sin(turn)
    poses[:, 2, 1] = np.sin(turn)
    return poses

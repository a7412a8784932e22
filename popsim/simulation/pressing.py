"""Pushing plates flat, as the closed pages or a hand do it."""

from typing import Any

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray, cross

PRESSING = 3e5
"""Acceleration over height, 1/s^2: takes off a third of what is left in each step from rest."""

Y_AXIS = np.array([0.0, 1.0, 0.0])


def pressing_wrenches(model: Any, data: Any, bodies: IntArray, normals: FloatArray) -> FloatArray:
    """Forces and torques that push bodies (k,) into the plane y = 0 and turn them to lie in it, shape (k, 6).

    `model` and `data` are MuJoCo's own, with bodies placed; `normals` are those of the plates in the frame of
    their bodies, shape (k, 3).
    """
    turned = (data.xmat[bodies].reshape(-1, 3, 3) @ normals[:, :, None])[..., 0]
    pushes = np.zeros((len(bodies), 6))
    pushes[:, 1] = -PRESSING * model.body_mass[bodies] * data.xipos[bodies, 1]
    torque = PRESSING * model.body_inertia[bodies, :1]
    pushes[:, 3:] = torque * cross(turned, np.sign(turned[:, 1:2]) * Y_AXIS)
    return pushes

"""How exactly poses are determined by their loops."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.rig import Rig
from popsim.simulation.stability import SINGULAR
from popsim.simulation.sweep import Sweep


def blur(rig: Rig, sweep: Sweep, frames: IntArray) -> FloatArray:
    """How far plates may be off for the gap that is left in their loops, to first order, mm, shape (k,).

    The gap over the gap per motion of the softest motion, at recorded angles (k,). Thin parallelograms are soft
    near the closed card: of one of 2 mm by 108 mm, at one degree, a plate that is off by 0.04 mm opens its loops
    by no more than 0.00002 mm.
    """
    poses = sweep.poses[frames]
    _, stiffness = rig.jacobian.nullity(poses, SINGULAR)
    gaps = np.linalg.norm(rig.jacobian.residual(poses), axis=(1, 2))
    return np.asarray(gaps / stiffness)

"""Hinges as springs."""

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.turning import angles_between, turnings


class Creases:
    """All hinges of a design, the central fold among them, in its order.

    Every crease rests where its two patches are at right angles. That needs no knowledge of which way a flap is
    turned: turned the other way, the fold is bent from its rest by the same angle.

    Attributes
    ----------
    first, second:
        Positions of the two patches of each hinge, shape (h,).
    axes:
        Ends of their axes in the open pose, mm, shape (h, 2, 3).
    lengths:
        mm, shape (h,).
    """

    def __init__(self, design: Design) -> None:
        self._hinges = design.hinges
        place = {patch.id: index for index, patch in enumerate(design.patches)}
        ends = np.array([[place[name] for name in hinge.patches] for hinge in design.hinges], dtype=np.int64)
        self.first: IntArray
        self.second: IntArray
        self.first, self.second = ends.reshape(-1, 2).T
        self.axes: FloatArray = np.array([hinge.points for hinge in design.hinges]).reshape(-1, 2, 3)
        self.lengths: FloatArray = np.array([hinge.length for hinge in design.hinges])
        self._between = angles_between(design, design.hinges)

    def bent(self, poses: FloatArray) -> FloatArray:
        """How far each crease is turned from its rest in poses (n, p, 4, 4), rad, shape (n, h).

        Between -pi/2 and pi/2; positive where the second patch is turned too far, right-handed about the axis.
        """
        turns = turnings(self._hinges, poses[:, self.first], poses[:, self.second])
        return np.asarray(np.mod(self._between + turns, np.pi) - np.pi / 2)

    def directions(self, poses: FloatArray) -> FloatArray:
        """Unit directions of the axes as first patches carry them in poses (n, p, 4, 4), shape (n, h, 3)."""
        along = (self.axes[:, 1] - self.axes[:, 0]) / self.lengths[:, None]
        return np.asarray((poses[:, self.first, :3, :3] @ along[..., None])[..., 0])

"""The recorded motion of the finished pop-up, part by part.

What has all joints made follows this motion; with fewer joints it can still follow it, and more. So this is where
hands lead what is half made; whether it folds flat is simulated (:mod:`popsim.assembly.folding`).
"""

from functools import cached_property

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout import Layout
from popsim.simulation import Sweep

NEARLY_FLAT = np.radians(8.0)
"""Fold angle at which things lie flat on the table: layers touch at 0, and which lies on which cannot be told."""


class Reference:
    """Poses of all parts of a layout while the finished pop-up closes.

    Attributes
    ----------
    layout:
        The layout whose parts are meant.
    theta:
        Recorded fold angles, rad, from open to closed, shape (n,).
    poses:
        Motion of each part from the open pose, by part id, each of shape (n, 4, 4).
    """

    def __init__(self, layout: Layout, sweep: Sweep) -> None:
        last = sweep.closed + 1
        self.layout = layout
        self.theta = sweep.theta[:last]
        self.poses = {name: sweep.poses[:last, sweep.index[part.patch.id]] for name, part in layout.parts.items()}

    @property
    def folds_flat(self) -> bool:
        """Whether the motion goes on to where everything lies nearly flat."""
        return bool(self.theta[-1] < NEARLY_FLAT)

    def frame(self, theta: float) -> int:
        """The frame nearest to a fold angle, rad."""
        return int(np.abs(self.theta - theta).argmin())

    def at(self, theta: float) -> dict[str, FloatArray]:
        """Poses (4, 4) of all parts at the recorded angle nearest to `theta`, rad."""
        frame = self.frame(theta)
        return {name: poses[frame] for name, poses in self.poses.items()}

    @cached_property
    def flat(self) -> dict[str, FloatArray]:
        """Poses (4, 4) of all parts as they lie nearly flat."""
        return self.at(NEARLY_FLAT)


STACKED = np.array([0.0, 1.0, 0.0])
"""Across the closed card, from the backdrop to the ground."""

"""The recorded motion of the finished pop-up, part by part.

What has all joints made follows this motion; with fewer joints it can still follow it, and more. So every partial
structure can be folded flat, and opened again, along the poses that were recorded for the whole.
"""

from functools import cached_property

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
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

    @cached_property
    def gaps(self) -> dict[str, float]:
        """How far the two sides of each joint come apart on the way, at most, mm, by joint id."""
        found = {}
        for joint in self.layout.joints:
            ends = np.concatenate(joint.stretches)
            first, second = (transform(self.poses[name], ends) for name in joint.parts)
            found[joint.id] = float(np.linalg.norm(first - second, axis=-1).max())
        return found

    @cached_property
    def closed_heights(self) -> dict[str, tuple[float, float]]:
        """Least and greatest height of each part over the plane of the closed card, mm, by id."""
        found = {}
        for name, part in self.layout.parts.items():
            corners = part.plane.lift(np.array(part.polygon.exterior.coords))
            heights = transform(self.poses[name][-1], corners) @ STACKED
            found[name] = float(heights.min()), float(heights.max())
        return found


STACKED = np.array([0.0, 1.0, 0.0])
"""Across the closed card, from the backdrop to the ground."""

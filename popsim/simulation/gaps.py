"""How far the two sides of each hinge come apart."""

from dataclasses import dataclass

import numpy as np

from popsim.design import Hinge
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.sweep import Sweep


@dataclass(frozen=True, eq=False)
class Gaps:
    """Loop gaps of a sweep.

    Attributes
    ----------
    hinges:
        The hinges that were measured.
    theta:
        Fold angles, rad, shape (n,).
    gap:
        Larger distance between the two images of an end of the axis, mm, shape (n, h).
    """

    hinges: tuple[Hinge, ...]
    theta: FloatArray
    gap: FloatArray

    @property
    def largest(self) -> float:
        """Largest gap, mm; 0 where nothing closes a loop."""
        return float(self.gap.max(initial=0.0))

    @property
    def worst(self) -> tuple[Hinge, float] | None:
        """Hinge and fold angle (rad) of the largest gap."""
        if not self.gap.size:
            return None
        angle, hinge = np.unravel_index(int(self.gap.argmax()), self.gap.shape)
        return self.hinges[int(hinge)], float(self.theta[angle])

    @property
    def by_angle(self) -> FloatArray:
        """Largest gap at each angle, mm, shape (n,)."""
        return np.asarray(self.gap.max(axis=1, initial=0.0))


def loop_gaps(sweep: Sweep, hinges: tuple[Hinge, ...]) -> Gaps:
    """Measure how well `hinges` hold at each recorded pose, with nothing taken from the solver."""
    if not hinges:
        return Gaps(hinges, sweep.theta, np.zeros((len(sweep.theta), 0)))
    axes = np.array([hinge.points for hinge in hinges])
    first, second = (
        transform(sweep.poses[:, [sweep.index[hinge.patches[side]] for hinge in hinges]], axes) for side in (0, 1)
    )
    return Gaps(hinges, sweep.theta, np.linalg.norm(first - second, axis=-1).max(axis=-1))

"""The fold angles that are recorded, and the steps between them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.frame import OPEN
from popsim.simulation.solver import END_DEGREES, Pacing


@dataclass(frozen=True)
class Schedule:
    """Closing from 180 to 0 degrees and opening again, in `count` equal recorded angles each way."""

    count: int
    pacing: Pacing

    @cached_property
    def recorded(self) -> FloatArray:
        """Recorded fold angles, rad, shape (2 count + 1,); the first and the last are fully open."""
        closing = np.linspace(OPEN, 0.0, self.count + 1)
        return np.concatenate([closing, closing[-2::-1]])

    @cached_property
    def driven(self) -> FloatArray:
        """Fold angle of the pages at each driven step, rad, shape (n,)."""
        legs = [
            start + (end - start) * np.arange(1, steps + 1) / steps
            for start, end, steps in zip(self.recorded[:-1], self.recorded[1:], self.leg_steps, strict=True)
        ]
        return np.concatenate(legs)

    @cached_property
    def leg_steps(self) -> IntArray:
        """Driven steps before each recorded angle but the first, shape (2 count,)."""
        near = np.minimum(self.recorded, OPEN - self.recorded)
        at_end = np.minimum(near[:-1], near[1:]) < np.radians(END_DEGREES) - 1e-9
        return np.where(at_end, self.pacing.end_steps, self.pacing.steps)

    @cached_property
    def settle_steps(self) -> IntArray:
        """Steps with the pages held at each recorded angle, shape (2 count + 1,)."""
        near = np.minimum(self.recorded, OPEN - self.recorded)
        at_end = near < np.radians(END_DEGREES) - 1e-9
        return np.where(at_end, self.pacing.end_settle, self.pacing.settle)

    @property
    def total_steps(self) -> int:
        """All integration steps, settling included."""
        return int(self.leg_steps.sum() + self.settle_steps.sum())

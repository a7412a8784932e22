"""The fold angles that are recorded, and the steps between them."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.frame import OPEN
from popsim.simulation.solver import END_DEGREES, Pacing

SAME = 1e-6
"""Degrees; stops nearer to each other are one."""


@dataclass(frozen=True)
class Schedule:
    """Closing from 180 to 0 degrees and opening again, in `count` equal recorded angles each way.

    How finely the card is driven depends on the fold angle alone, not on how many angles are recorded.
    """

    count: int
    pacing: Pacing

    @cached_property
    def recorded(self) -> FloatArray:
        """Recorded fold angles, rad, shape (2 count + 1,); the first and the last are fully open."""
        return _there_and_back(np.linspace(OPEN, 0.0, self.count + 1))

    @cached_property
    def stops(self) -> FloatArray:
        """Fold angles at which the pages are held, the recorded ones among them, rad, shape (m,)."""
        borders = np.linspace(OPEN, 0.0, self.count + 1)
        for end in np.radians([180 - END_DEGREES, END_DEGREES]):
            if np.abs(borders - end).min() > np.radians(SAME):
                borders = np.sort(np.append(borders, end))[::-1]
        apart = np.radians(np.where(_at_end(borders[:-1], borders[1:]), self.pacing.end_stops, self.pacing.stops))
        parts = np.asarray(np.ceil((borders[:-1] - borders[1:]) / apart - SAME), dtype=np.int64)
        return _there_and_back(np.append(OPEN, _evenly(borders, parts)))

    @cached_property
    def is_recorded(self) -> BoolArray:
        """Which of the stops are recorded, shape (m,)."""
        return np.isin(self.stops, self.recorded)

    @cached_property
    def driven(self) -> FloatArray:
        """Fold angle of the pages at each driven step, rad, shape (n,)."""
        return _evenly(self.stops, self.leg_steps)

    @cached_property
    def leg_steps(self) -> IntArray:
        """Driven steps before each stop but the first, shape (m - 1,)."""
        high, low = np.maximum(self.stops[:-1], self.stops[1:]), np.minimum(self.stops[:-1], self.stops[1:])
        density = np.where(_at_end(high, low), self.pacing.end_steps, self.pacing.steps)
        return np.asarray(np.ceil(np.degrees(high - low) * density - SAME), dtype=np.int64)

    @cached_property
    def settle_steps(self) -> IntArray:
        """Steps with the pages held at each stop, shape (m,)."""
        at_end = np.minimum(self.stops, OPEN - self.stops) < np.radians(END_DEGREES - SAME)
        return np.where(at_end, self.pacing.end_settle, self.pacing.settle)

    @property
    def total_steps(self) -> int:
        """All integration steps, settling included."""
        return int(self.leg_steps.sum() + self.settle_steps.sum())


@lru_cache(maxsize=8)
def schedule_of(count: int, pacing: Pacing) -> Schedule:
    """The schedule, made once: a campaign asks for the same thousands of times."""
    return Schedule(count, pacing)


def _at_end(high: FloatArray, low: FloatArray) -> BoolArray:
    """Whether legs between fold angles lie within END_DEGREES of either end."""
    end = np.radians(END_DEGREES + SAME)
    return np.asarray((high < end) | (low > OPEN - end))


def _evenly(borders: FloatArray, parts: IntArray) -> FloatArray:
    """The leg before each border but the first in so many equal parts: their ends, the border itself exactly."""
    last = np.cumsum(parts)
    number = np.arange(1, last[-1] + 1) - np.repeat(last - parts, parts)
    angles = np.repeat(borders[:-1], parts) + np.repeat(np.diff(borders) / parts, parts) * number
    angles[last - 1] = borders[1:]
    return np.asarray(angles)


def _there_and_back(closing: FloatArray) -> FloatArray:
    return np.concatenate([closing, closing[-2::-1]])

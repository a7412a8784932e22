"""Room for a mechanism that is drawn by chance, and how its lengths are drawn."""

from dataclasses import dataclass

from numpy.random import Generator

LEAST = 4.0
"""mm; the smallest length that is drawn: what scissors and fingers still manage."""

GRAIN = 3
"""Decimals of drawn lengths: short numbers in files, and the same ones on every machine."""


@dataclass(frozen=True)
class Room:
    """What a mechanism and all that will stand on it may take.

    Attributes
    ----------
    x:
        Interval along the central fold that closing ranges stay within, mm.
    extent:
        How far from the central fold everything may reach when closed, mm.
    """

    x: tuple[float, float]
    extent: float

    def within(self, low: float, high: float) -> "Room":
        """The part of it between two x."""
        return Room((max(self.x[0], low), min(self.x[1], high)), self.extent)

    def mirrored(self) -> "Room":
        """The same room seen along -x."""
        return Room((-self.x[1], -self.x[0]), self.extent)


def draw(rng: Generator, low: float, high: float) -> float:
    """Length between two limits, mm, to GRAIN decimals."""
    value = round(low + (high - low) * float(rng.random()), GRAIN)
    return float(min(max(value, low), high))


def draw_interval(rng: Generator, low: float, high: float, least: float = LEAST) -> tuple[float, float]:
    """Interval of at least `least` mm between two limits, which are at least that far apart."""
    length = draw(rng, least, high - low)
    start = draw(rng, low, high - length)
    return start, min(start + length, high)

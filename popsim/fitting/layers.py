"""The layers of a model (Sec. 4.3, Eq. 3) over a spot: in which columns a row may step, and how high it may be."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.fitting.field import Spot
from popsim.geometry.arrays import BoolArray, FloatArray

NEAR = 0.75
"""Cells within which a border belongs to a layer."""


class Allowed(NamedTuple):
    """Where rows may rise or fall with x, shape (columns,) each, and which heights they may have, (heights,)."""

    rise: BoolArray
    fall: BoolArray
    height: BoolArray


@dataclass(frozen=True, eq=False)
class Layers:
    """Positions of the layers that the views of a model fall into, card frame, mm, each of shape (n,).

    Attributes
    ----------
    tops:
        Heights of those seen from above.
    fronts, backs:
        Along x, of those seen from the front and from the back.
    """

    tops: FloatArray
    fronts: FloatArray
    backs: FloatArray

    @staticmethod
    def of(*positions: tuple[float, ...]) -> "Layers":
        """From tops, fronts and backs."""
        return Layers(*(np.array(own, dtype=np.float64) for own in positions))

    def allowed(self, spot: Spot) -> Allowed:
        """Which borders of cells over a spot lie at layers."""
        columns, _, heights = spot.gain.shape
        x = spot.start[0] + np.arange(columns) * spot.cell
        z = spot.start[2] + (np.arange(heights) + 1) * spot.cell
        return Allowed(
            *(_near(at, own, NEAR * spot.cell) for at, own in ((x, self.backs), (x, self.fronts), (z, self.tops)))
        )


def _near(at: FloatArray, positions: FloatArray, reach: float) -> BoolArray:
    """Which of some coordinates lie within reach of any position."""
    if not len(positions):
        return np.zeros(len(at), dtype=bool)
    return np.asarray(np.abs(at[:, None] - positions).min(axis=1) <= reach)

"""Upright wedges and boxes that stand on a corner, on an opening pair: what v-folds represent."""

from typing import Literal

import numpy as np

from popsim.fitting.field import Spot
from popsim.fitting.proposal import Proposal
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Primitive, RectangularPrism, TriangularPrism

LEAST = 2
"""Cells; a wedge shallower than this is noise."""

NOTHING = -1e12
"""Gain of what does not fit."""


def propose_wedges(spot: Spot) -> list[Proposal]:
    """The wedges facing either way and the turned box that gain most, as far as there are any."""
    sums = spot.summed[:, 1:, 1:]
    forward = _wedges(sums)
    backward = _wedges(sums[::-1])[::-1]
    found = []
    for facing, gain in ((1, forward), (-1, backward), (0, _turned(forward, backward))):
        x, a, h = (int(k) for k in np.unravel_index(int(gain.argmax()), gain.shape))
        if gain[x, a, h] > 0 and a + 1 >= LEAST:
            found.append(Proposal(_primitive(spot, (x, a, h), facing), spot.pair, float(gain[x, a, h])))
    return found


def _wedges(sums: FloatArray) -> FloatArray:
    """Gain of wedges with their tip at the high end of each column, by depth and height: (x, a, h).

    A wedge of depth a covers one cell along u in the column of its tip, two in the one behind it, and so on.
    """
    columns, widths, heights = sums.shape
    gain = np.full((columns, widths, heights), NOTHING)
    total = np.zeros((columns, heights))
    for back in range(min(columns, widths)):
        total[back:] += sums[: columns - back, back]
        gain[back:, back] = total[back:]
    return gain


def _turned(forward: FloatArray, backward: FloatArray) -> FloatArray:
    """Gain of boxes on their corner, by the column of their front tip: two wedges back to back."""
    columns, depths, _ = forward.shape
    gain = np.full(forward.shape, NOTHING)
    for a in range(depths):
        length = 2 * (a + 1) - 1  # from the column of one tip to that of the other
        if length < columns:
            gain[length:, a] = forward[length:, a] + backward[: columns - length, a]
    return gain


def _primitive(spot: Spot, index: tuple[int, int, int], facing: int) -> Primitive:
    """The primitive of an entry (column of the tip, depth, height); facing 0 is the turned box."""
    x, a, h = index
    length = (a + 1) * (1 if facing else 2)
    first = x if facing == -1 else x + 1 - length
    x0, half, z1 = spot.place(first, a + 1, h + 1)
    x1 = spot.place(first + length, 0, 0)[0]
    low, high = (float(x0), -float(half), spot.pair.v), (float(x1), float(half), float(z1))
    if facing == 0:
        return RectangularPrism(low, high, turned=True)
    toward: Literal[1, -1] = 1 if facing == 1 else -1
    return TriangularPrism(low, high, edges="z", facing=toward)

"""Triangular prisms along the fold: roofs on an opening pair."""

import numpy as np

from popsim.fitting.field import Spot
from popsim.fitting.proposal import Proposal
from popsim.fitting.runs import best_run
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.mechanisms import TriangularPrism

STRIDE = 2
"""Cells between the heights that are tried; refitting finds those between."""

LEAST = 2
"""Cells; a roof narrower or lower than this is noise."""


def propose_roof(spot: Spot) -> Proposal | None:
    """The roof that gains most on an opening pair, or None."""
    from popsim.fitting.kernels.roofs import gains

    _, wide, high = spot.gain.shape
    if wide < LEAST or high < LEAST:
        return None
    halves, heights = np.arange(LEAST, wide + 1), np.arange(LEAST, high + 1, STRIDE)
    reach = _reach(halves, heights, high)
    across = np.concatenate([np.zeros((len(spot.gain), 1, high)), spot.gain.cumsum(axis=1)], axis=1)
    gain, first, last = best_run(gains(across, reach, heights))
    t, h = (int(k) for k in np.unravel_index(int(gain.argmax()), gain.shape))
    if not gain[t, h] > 0:
        return None
    low, top = spot.place(int(first[t, h]), 0, 0), spot.place(int(last[t, h]), int(halves[t]), int(heights[h]))
    half = float(top[1])
    prism = TriangularPrism((float(low[0]), -half, spot.pair.v), (float(top[0]), half, float(top[2])), edges="x")
    return Proposal(prism, spot.pair, float(gain[t, h]))


def _reach(halves: FloatArray | IntArray, heights: FloatArray | IntArray, levels: int) -> IntArray:
    """Cells along u inside a triangle, per half base, height and level: shape (t, h, levels)."""
    level = (np.arange(levels) + 0.5)[None, None]
    inside = halves[:, None, None] * (1 - level / heights[None, :, None])
    return np.asarray(np.maximum(np.floor(inside + 0.5), 0).astype(np.int64))

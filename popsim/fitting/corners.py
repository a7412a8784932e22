"""Rectangular prisms in a corner pair: beside a box, on either side alone."""

import numpy as np

from popsim.fitting.field import Spot
from popsim.fitting.proposal import Proposal
from popsim.fitting.runs import best_run
from popsim.mechanisms import RectangularPrism


def propose_corner(spot: Spot) -> Proposal | None:
    """The prism that gains most in a corner, or None."""
    gain, first, last = best_run(spot.summed[:, 1:, 1:])
    s, h = (int(k) for k in np.unravel_index(int(gain.argmax()), gain.shape))
    if not gain[s, h] > 0:
        return None
    pair = spot.pair
    x0, x1 = (float(spot.place(int(end[s, h]), 0, 0)[0]) for end in (first, last))
    _, u, v = spot.place(0, s + 1, h + 1)
    y0, y1 = sorted((pair.side.value * pair.u, pair.side.value * float(u)))
    prism = RectangularPrism((x0, y0, pair.v), (x1, y1, float(v)))
    return Proposal(prism, pair, float(gain[s, h]))

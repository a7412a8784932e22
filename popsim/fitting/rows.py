"""Rows of rectangular prisms on an opening pair, by dynamic programming over x."""

import numpy as np

from popsim.fitting.field import Spot
from popsim.fitting.layers import Allowed
from popsim.fitting.proposal import Prices, Proposal
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import PrismRow

STEP_PATCHES = 4
"""A top and an end pair: what each step of a profile costs."""

STAND_PATCHES = 9
"""Patches of the simplest box that could later stand on a top."""

OUTSIDE = -1e9
"""Value of a column that may not be used."""


def propose_row(
    spot: Spot, prices: Prices, room: BoolArray | None = None, allowed: Allowed | None = None
) -> Proposal | None:
    """The row of prisms that gains most on an opening pair.

    Parameters
    ----------
    spot:
        The pair and the field over it.
    prices:
        What patches cost.
    room:
        Columns free for a row of each width, as a mask (x, w); None for all. Rows need w more at each end than
        they cover (closing range), which the caller knows.
    allowed:
        Where it may have steps and tops; None for everywhere.
    """
    from popsim.fitting.kernels.rows import profiles, with_later

    sums = spot.summed[:, 1:, 1:]
    value = with_later(sums, prices.trust, prices.patch * STAND_PATCHES / max(1, len(sums) / 3))
    if room is not None:
        value = np.where(room[:, : value.shape[1], None], value, OUTSIDE)
    step = np.full((2, len(value)), -OUTSIDE if prices.plain else prices.patch * STEP_PATCHES)
    if allowed is not None:
        value = np.where(allowed.height, value, OUTSIDE)
        step[~np.array([allowed.rise, allowed.fall])] = -OUTSIDE
    best = profiles(value, step, OUTSIDE)
    final = best.max(axis=1)
    x, w, h = (int(k) for k in np.unravel_index(int(final.argmax()), final.shape))
    if not final[x, w, h] > 0:
        return None
    profile = _profile(best[: x + 1, :, w], h, step)
    tops = _tops(profile, x + 1 - len(profile))
    gain = float(sum(sums[a:b, w, top].sum() for a, b, top in tops))
    return _as_proposal(spot, tops, w, gain)


def _profile(best: FloatArray, h: int, step: FloatArray) -> list[int]:
    """Height indices, column by column, of the best profile of one width that ends in the last column at h.

    `best` is what :func:`popsim.fitting.kernels.rows.profiles` gives for this width, shape (columns, 2, heights),
    `step` as there. Of equals a profile that starts goes before one that stays, that before one that steps, and of
    steps the lowest.
    """
    phase = int(best[-1, :, h].argmax())
    profile = [h]
    for x in range(len(best) - 1, 0, -1):
        rising, falling = best[x - 1]
        if phase == 0:
            lower = float(rising[:h].max(initial=-np.inf)) - step[0, x]
            if max(rising[h], lower) <= 0:
                break
            if lower > rising[h]:
                h = int(np.flatnonzero(rising[:h] == rising[:h].max())[-1])
        else:
            both = np.maximum(rising, falling)
            if h + 1 < len(both) and both[h + 1 :].max() - step[1, x] > falling[h]:
                h += 1 + int(both[h + 1 :].argmax())
                phase = int(falling[h] >= rising[h])
        profile.append(h)
    return profile[::-1]


def _tops(profile: list[int], first: int) -> list[tuple[int, int, int]]:
    """Tops (first column, column after the last, height index) of a profile that begins in column `first`."""
    tops: list[tuple[int, int, int]] = []
    for column, height in enumerate(profile, first):
        if tops and tops[-1][2] == height:
            tops[-1] = (tops[-1][0], column + 1, height)
        else:
            tops.append((column, column + 1, height))
    return tops


def _as_proposal(spot: Spot, tops: list[tuple[int, int, int]], w: int, gain: float) -> Proposal:
    row = []
    for a, b, h in tops:
        x1, half, top = spot.place(b, w + 1, h + 1)
        row.append((float(spot.place(a, 0, 0)[0]), float(x1), float(top) - spot.pair.v))
    return Proposal(PrismRow(float(half), spot.pair.v, tuple(row)), spot.pair, gain)

"""Rows of rectangular prisms on an opening pair, by dynamic programming over x."""

from dataclasses import dataclass

import numpy as np

from popsim.fitting.field import Spot
from popsim.fitting.proposal import Prices, Proposal
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.mechanisms import PrismRow

STEP_PATCHES = 4
"""A top and an end pair: what each step of a profile costs."""

STAND_PATCHES = 9
"""Patches of the simplest box that could later stand on a top."""

OUTSIDE = -1e9
"""Value of a column that may not be used."""


@dataclass(frozen=True, eq=False)
class _Table:
    """Best value and step before it, per column x, width w and height h; phase 0 rises, phase 1 falls."""

    best: FloatArray
    came: IntArray


def propose_row(spot: Spot, prices: Prices, room: BoolArray | None = None) -> Proposal | None:
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
    """
    sums = spot.summed()[:, 1:, 1:]
    value = sums + prices.trust * _later(sums, prices)
    if room is not None:
        value = np.where(room[:, : value.shape[1], None], value, OUTSIDE)
    phases = _run(value, -OUTSIDE if prices.plain else prices.patch * STEP_PATCHES)
    final = phases.best.max(axis=1)
    x, w, h = (int(k) for k in np.unravel_index(int(final.argmax()), final.shape))
    if not final[x, w, h] > 0:
        return None
    tops = _trace(phases, x, w, h)
    gain = float(sum(sums[a:b, w, top].sum() for a, b, top in tops))
    return _as_proposal(spot, tops, w, gain)


def _later(sums: FloatArray, prices: Prices) -> FloatArray:
    """What one more box of at most the same width could gain above each height, per column, less its price."""
    columns = len(sums)
    above = np.maximum.accumulate(sums[..., ::-1], axis=2)[..., ::-1] - sums
    best = np.maximum.accumulate(above, axis=1)
    share = prices.patch * STAND_PATCHES / max(1, columns / 3)
    return np.asarray(np.maximum(best - share, 0.0))


def _run(value: FloatArray, step: float) -> _Table:
    """Best profiles that first rise and then fall, ending in each column at each height."""
    columns, widths, heights = value.shape
    best = np.full((columns, 2, widths, heights), OUTSIDE)
    came = np.full((columns, 2, widths, heights), -1, dtype=np.int64)
    rows = np.arange(heights)
    for x in range(columns):
        start = np.zeros((widths, heights))
        if x == 0:
            best[x, 0] = value[x]
            continue
        rising, falling = best[x - 1, 0], best[x - 1, 1]
        lower, lower_at = _best_below(rising)
        options = np.stack([start, rising, lower - step])
        pick = options.argmax(axis=0)
        best[x, 0] = value[x] + np.take_along_axis(options, pick[None], 0)[0]
        came[x, 0] = np.where(pick == 0, -1, np.where(pick == 1, rows, lower_at))
        both = np.maximum(rising, falling)
        turned = np.where(falling >= rising, heights, 0)
        higher, higher_at = _best_below(both[:, ::-1])
        higher, higher_at = higher[:, ::-1], heights - 1 - higher_at[:, ::-1]
        fallen = np.take_along_axis(turned, np.clip(higher_at, 0, heights - 1), axis=1)
        options = np.stack([falling, higher - step])
        pick = options.argmax(axis=0)
        best[x, 1] = value[x] + np.take_along_axis(options, pick[None], 0)[0]
        came[x, 1] = np.where(pick == 0, rows + heights, higher_at + fallen)
    return _Table(best, came)


def _best_below(values: FloatArray) -> tuple[FloatArray, IntArray]:
    """Greatest value at any smaller index of the last axis, and that index (0 and OUTSIDE at index 0)."""
    best = np.full(values.shape, OUTSIDE)
    at = np.zeros(values.shape, dtype=np.int64)
    running = np.maximum.accumulate(values, axis=1)
    record = np.where(values >= running, np.arange(values.shape[1]), 0)
    best[:, 1:] = running[:, :-1]
    at[:, 1:] = np.maximum.accumulate(record, axis=1)[:, :-1]
    return best, at


def _trace(table: _Table, x: int, w: int, h: int) -> list[tuple[int, int, int]]:
    """Tops (first column, column after the last, height index) of the profile that ends at x."""
    heights = table.best.shape[-1]
    phase = int(table.best[x, :, w, h].argmax())
    profile = [(x, h)]
    while True:
        before = int(table.came[x, phase, w, h])
        if before < 0:
            break
        phase, h = divmod(before, heights)
        x -= 1
        profile.append((x, h))
    tops: list[tuple[int, int, int]] = []
    for column, height in reversed(profile):
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

"""Drawing box-folds by chance, plain and layered, with all or some of their end pairs; and spoiling them."""

from typing import TypeVar

import numpy as np
from numpy.random import Generator

from popsim.geometry.frame import Z_AXIS
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top, step_pairs
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.pair import BasePatchPair
from popsim.mechanisms.room import GRAIN, LEAST, Room, draw, draw_interval

LEAST_STEP = 1.0
"""mm; the least difference in height between neighbouring tops."""

Box = TypeVar("Box", bound=BoxFold)


def random_box(kind: type[Box], rng: Generator, pair: BasePatchPair, id: str, room: Room) -> Box | None:
    """Draw a box-fold; see :meth:`popsim.mechanisms.Mechanism.random`."""
    left = room.extent - pair.v
    widest = min(*pair.reach, (room.x[1] - room.x[0] - LEAST) / 3, left / 3)
    if widest < LEAST:
        return None
    half = draw(rng, max(LEAST, 0.3 * widest), widest)
    low, high = max(pair.x[0], room.x[0] + half), min(pair.x[1], room.x[1] - half)
    if high - low < LEAST:
        return None
    x = draw_interval(rng, low, high)
    tops = _random_tops(rng, x, half, draw(rng, LEAST, max(LEAST, 0.6 * (left - half))))
    return kind(id, pair, half, tops, _random_pairs(rng, step_pairs(tops)))


def ridge_faults(box: BoxFold) -> tuple[Fault, ...]:
    """A lower ridge for each top: a shorter backbone, longer tops."""
    faults = []
    for k, (top, roles) in enumerate(zip(box.tops, box.top_roles(), strict=True)):
        lower = [other.height for other in box.tops[max(k - 1, 0) : k + 2] if other.height < top.height]
        ridge = np.array([[x, 0.0, box.pair.v + top.height] for x in (top.x0, top.x1)])
        most = (top.height - max(lower, default=0.0)) / 2
        faults.append(Fault("b + r = c + t_b", (*roles, "C"), ridge, -Z_AXIS, most))
    return tuple(faults)


def _random_tops(rng: Generator, x: tuple[float, float], half: float, height: float) -> tuple[Top, ...]:
    """One to three tops, the highest at `height`: a staircase falling to both ends, or a wide enough valley."""
    count = (1, 1, 2, 3)[rng.integers(4)]
    spare = x[1] - x[0] - count * LEAST
    if count == 1 or spare < 0 or height < 4 * count * LEAST_STEP:
        return (Top(*x, height),)
    cuts = sorted(draw(rng, 0.0, spare) for _ in range(count - 1))
    ends = [x[0], *(x[0] + cut + (k + 1) * LEAST for k, cut in enumerate(cuts)), x[1]]
    heights = [height]
    for _ in range(1, count):
        heights.append(round(heights[-1] - draw(rng, LEAST_STEP, height / 2 / (count - 1)), GRAIN))
    order = [(0, 1), (1, 0)][rng.integers(2)] if count == 2 else [(0, 1, 2), (2, 1, 0), (1, 0, 2)][rng.integers(3)]
    if count == 3 and ends[2] - ends[1] > 2 * half and rng.random() < 0.5:
        order = (0, 2, 1)
    return tuple(Top(ends[k], ends[k + 1], heights[rank]) for k, rank in enumerate(order))


def _random_pairs(rng: Generator, pairs: tuple[EndPair, ...]) -> tuple[EndPair, ...]:
    """All, or some of the pairs (at least one), some spanning a part of their height only."""
    kept = list(pairs)
    if rng.random() < 0.3:
        sure = int(rng.integers(len(kept)))
        kept = [pair for k, pair in enumerate(kept) if k == sure or rng.random() < 0.5]
    return tuple(_shortened(rng, pair) if rng.random() < 0.2 else pair for pair in kept)


def _shortened(rng: Generator, pair: EndPair) -> EndPair:
    if pair.high - pair.low < 2 * LEAST:
        return pair
    low, high = draw_interval(rng, pair.low, pair.high)
    return pair._replace(low=low, high=high)

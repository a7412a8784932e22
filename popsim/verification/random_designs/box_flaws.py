"""Flaws that are planted among valid neighbours: boxes that shear, overlap, or cut their own roof, and a lean.

They are the known ways in which box-folds and v-folds go wrong, so they name those mechanisms.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from popsim.mechanisms import Mechanism
from popsim.mechanisms.box_fold import BoxFold, EndPair
from popsim.mechanisms.room import LEAST, draw
from popsim.mechanisms.v_fold_2 import VFold2
from popsim.verification.random_designs.growth import GAP, Growth, Slot

LEAST_HALF = 6.0
"""mm; the least half width of a box with a flaw, so that the damage shows."""

OVERLAP = 10.0
"""mm; by how much ranges overlap at least."""


def plant_shear(growth: Growth, slot: Slot) -> str | None:
    """A box without any front or back pair: it keeps one free motion."""
    box = BoxFold.random(growth.rng, slot.pair, growth.next_id(), slot.room)
    if box is None:
        return None
    growth.add(replace(box, end_pairs=()), slot)
    return f"{box.id} has neither front nor back pairs"


def plant_overlap(growth: Growth, slot: Slot) -> str | None:
    """Two boxes so near that the front pair of one and the back pair of the other sweep through each other."""
    rng, (low, high) = growth.rng, slot.room.within(*slot.pair.x).x
    left = slot.room.extent - slot.pair.v
    widest = min(*slot.pair.reach, left / 3, (high - low) / 8)
    if widest < LEAST_HALF:
        return None
    halves = [draw(rng, max(LEAST_HALF, 0.7 * widest), widest) for _ in range(2)]
    overlap = draw(rng, min(OVERLAP, sum(halves) - GAP), sum(halves) - GAP)
    middle, gap = draw(rng, low + 3 * widest, high - 3 * widest), sum(halves) - overlap
    ends = (
        (draw(rng, low + halves[0], middle - gap - LEAST), middle - gap),
        (middle, draw(rng, middle + LEAST, high - halves[1])),
    )
    boxes = [
        BoxFold.plain(growth.next_id(k + 1), slot.pair, half, draw(rng, widest, left - half), x)
        for k, (half, x) in enumerate(zip(halves, ends, strict=True))
    ]
    growth.parts += boxes
    return f"ranges of {boxes[0].id} and {boxes[1].id} overlap by {overlap:g} mm"


def plant_lean(growth: Growth, slot: Slot) -> str | None:
    """A tall v-fold on a low box that leans into the higher box beside it."""
    rng, (low, high) = growth.rng, slot.room.within(*slot.pair.x).x
    left = slot.room.extent - slot.pair.v
    widest = min(*slot.pair.reach, left / 8, (high - low) / 12)
    if widest < LEAST_HALF:
        return None
    facing: Literal[1, -1] = 1 if rng.random() < 0.5 else -1
    half, other = (draw(rng, max(LEAST_HALF, 0.7 * widest), widest) for _ in range(2))
    flat, tall = draw(rng, LEAST, widest), draw(rng, 3 * widest + OVERLAP, left - other)
    near, start = 2.5 * widest, low if facing == 1 else -high

    def along(first: float, last: float) -> tuple[float, float]:
        ends = sorted(facing * (start + x) for x in (first, last))
        return ends[0], ends[1]

    far = half + near + half + other + GAP
    low_box = BoxFold.plain(growth.next_id(), slot.pair, half, flat, along(half, half + near))
    neighbour = BoxFold.plain(growth.next_id(2), slot.pair, other, tall, along(far, far + LEAST + near))
    top = next(pair for pair in low_box.pairs() if pair.kind is slot.pair.kind)
    rise = (half + GAP + OVERLAP) * np.sqrt(2)
    most = (left - flat) * np.sqrt(2) - half
    if rise > most:
        return None
    height = draw(rng, float(rise), float(min(most, rise + half)))
    tip = facing * (start + half + near)
    leaning = VFold2(growth.next_id(3), top, tip, half, height, facing, bool(rng.random() < 0.5))
    planted: list[Mechanism] = [low_box, neighbour, leaning]
    growth.parts += planted
    return f"{leaning.id} on {low_box.id} leans into {neighbour.id}"


def plant_inside_pair(growth: Growth, slot: Slot) -> str | None:
    """An end pair under a roof that goes on beyond it: closing, it cuts the roof."""
    box = BoxFold.random(growth.rng, slot.pair, growth.next_id(), slot.room)
    if box is None or len(box.tops) > 1 or box.half_width < LEAST_HALF:
        return None
    (top,) = box.tops
    reach = box.half_width
    if top.x1 - top.x0 < 2 * reach + LEAST:
        return None
    facing: Literal[1, -1] = 1 if growth.rng.random() < 0.5 else -1
    x = draw(growth.rng, top.x0 + reach, top.x1 - reach)
    inner = EndPair(x, draw(growth.rng, 0.0, top.height / 2), top.height, facing)
    growth.parts.append(replace(box, end_pairs=(*box.end_pairs, inner)))
    return f"{box.id} has a pair at x = {x:g} under a roof that goes on beyond it"

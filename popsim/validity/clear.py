"""Mechanisms that share a place do not meet while closing (Sec. 3.3.2, for whole subtrees)."""

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from popsim.mechanisms import Condition, Mechanism, PairKind
from popsim.validity.reach import Reach

TOUCH = 1e-6
"""mm; neighbours may touch, and rounding may not turn that into an overlap."""


def clear_conditions(mechanisms: Mapping[str, Mechanism], reach: Reach) -> list[Condition]:
    """Conditions for all siblings, and for each mechanism on a pair that leaves only part of its length free."""
    conditions = []
    for first, second in combinations(mechanisms.values(), 2):
        if first.pair.owner == second.pair.owner and first.pair.kind is second.pair.kind:
            if first.pair.kind is PairKind.OPENING:
                conditions.append(_apart_along_x(first, second, reach))
            elif first.pair.side is second.pair.side:
                conditions.append(_apart_in_corner(first, second, reach))
    for mechanism in mechanisms.values():
        conditions += _within_free(mechanism, mechanisms, reach)
    return conditions


def _apart_along_x(first: Mechanism, second: Mechanism, reach: Reach) -> Condition:
    """Closing ranges of two subtrees on opening pairs of one owner do not overlap."""
    a, b = reach.subtree(first.id), reach.subtree(second.id)
    gap = max(b[0] - a[1], a[0] - b[1])
    return Condition("clear", f"{first.id}, {second.id}", "closing ranges do not overlap", gap + TOUCH)


def _apart_in_corner(first: Mechanism, second: Mechanism, reach: Reach) -> Condition:
    """Boxes of two subtrees in skew coordinates, which do not change while closing, do not overlap."""
    a, b = reach.open_box(first.id), reach.open_box(second.id)
    gap = float(np.maximum(b[0] - a[1], a[0] - b[1]).max())
    return Condition("clear", f"{first.id}, {second.id}", "places in the corner do not overlap", gap + TOUCH)


def _within_free(mechanism: Mechanism, mechanisms: Mapping[str, Mechanism], reach: Reach) -> list[Condition]:
    """The subtree stays in what the owner of its pair leaves free."""
    owner = mechanisms.get(mechanism.pair.owner or "")
    if owner is None:
        return []
    offered = [pair.free for pair in owner.pairs() if set(pair.patches) == set(mechanism.pair.patches)]
    if not offered:
        return []
    low, high = reach.subtree(mechanism.id)
    margin = max(min(low - free[0], free[1] - high) for free in offered)
    if not np.isfinite(margin):
        return []
    name = f"stays clear of what {owner.id} sweeps"
    return [Condition("clear", mechanism.id, name, float(margin) + TOUCH)]

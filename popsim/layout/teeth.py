"""Sharing an edge: where one edge must carry the flaps of several joints, they take turns along it."""

from collections.abc import Mapping
from dataclasses import replace
from math import ceil

import numpy as np

from popsim.design.rules import TOUCHING
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.layout.joints import Joint

TOOTH = 20.0
"""mm; about the width of one flap."""


def share_edges(joints: tuple[Joint, ...], carriers: Mapping[str, tuple[str, ...]]) -> tuple[Joint, ...]:
    """Divide the stretches of joints that need the same edge among them, in turns.

    Parameters
    ----------
    carriers:
        By joint id, the parts that can carry its flap; joints that are folds are not in it.
    """
    bound = {name: parts[0] for name, parts in carriers.items() if len(parts) == 1}
    groups: list[list[Joint]] = []
    for joint in joints:
        if joint.id not in bound:
            continue
        for group in groups:
            if bound[group[0].id] == bound[joint.id] and any(_overlap(joint, other) for other in group):
                group.append(joint)
                break
        else:
            groups.append([joint])
    shared = {joint.id: joint for group in groups if len(group) > 1 for joint in _take_turns(group)}
    return tuple(shared.get(joint.id, joint) for joint in joints)


def _overlap(one: Joint, other: Joint) -> bool:
    axis = one.stretches[0]
    if max(float(line_distance(ends, axis).max()) for ends in other.stretches) > TOUCHING:
        return False
    spans = [[_along(ends, axis) for ends in joint.stretches] for joint in (one, other)]
    return any(min(a[1], b[1]) - max(a[0], b[0]) > TOUCHING for a in spans[0] for b in spans[1])


def _along(ends: FloatArray, axis: FloatArray) -> tuple[float, float]:
    """Extent of `ends` (2, 3) along the line of `axis`, mm from its start."""
    direction = (axis[1] - axis[0]) / np.linalg.norm(axis[1] - axis[0])
    low, high = sorted(float(v) for v in (ends - axis[0]) @ direction)
    return low, high


def _take_turns(group: list[Joint]) -> list[Joint]:
    axis = group[0].stretches[0]
    direction = (axis[1] - axis[0]) / np.linalg.norm(axis[1] - axis[0])
    spans = [_along(ends, axis) for joint in group for ends in joint.stretches]
    low, high = min(span[0] for span in spans), max(span[1] for span in spans)
    count = len(group) * ceil((high - low) / (TOOTH * len(group)))
    rims = np.linspace(low, high, count + 1)
    turns = []
    for turn, joint in enumerate(group):
        stretches = []
        for ends in joint.stretches:
            start, end = _along(ends, axis)
            for a, b in zip(rims[turn :: len(group)], rims[turn + 1 :: len(group)], strict=False):
                if min(b, end) - max(a, start) > TOUCHING:
                    stretches.append(axis[0] + np.array([[max(a, start)], [min(b, end)]]) * direction)
        turns.append(replace(joint, stretches=tuple(stretches)) if stretches else joint)
    return turns

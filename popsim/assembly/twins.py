"""Joints that are mirror images of each other: doing the same thing twice in a row is easier than twice apart."""

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout import Joint, Layout

ALIKE = 0.3
"""mm by which the ends of a joint may miss those of the mirror image of another."""

AS_LARGE = 0.02
"""Share by which the areas of parts may differ."""

Twins = Mapping[str, frozenset[str]]
"""The mirror images of each glue joint, by its id."""


def twins(layout: Layout, ends: Mapping[str, FloatArray]) -> Twins:
    """Glue joints of a layout that are mirror images of each other.

    Mirrors stand across the fold, in the middle of the card and of whatever the joint belongs to, or are the plane
    that swaps both pages, y = 0 of the open pose. `ends` of joints are those of the open pose, each (2, 3), mm.
    """
    glued = {flap.joint.id for flap in layout.flaps}
    joints = [joint for joint in layout.joints if joint.id in glued]
    lines = np.array([ends[joint.id] for joint in joints]).reshape(-1, 2, 3)
    sizes = np.array([_sizes(layout, joint) for joint in joints]).reshape(-1, 2)
    middles = _middles(layout)
    found: dict[str, frozenset[str]] = {}
    for place, joint in enumerate(joints):
        alike = np.zeros(len(joints), dtype=bool)
        homes = {None, *(layout.parts[part].patch.mechanism for part in joint.parts)}
        for image in _images(lines[place], {middles[home] for home in homes if home in middles}):
            near = [np.linalg.norm(lines - side, axis=-1).max(axis=-1) < ALIKE for side in (image, image[::-1])]
            alike |= near[0] | near[1]
        alike &= (np.abs(sizes - sizes[place]) < AS_LARGE * sizes).all(axis=1)
        alike[place] = False
        found[joint.id] = frozenset(joints[k].id for k in np.flatnonzero(alike))
    return found


def apart(twins: Twins, order: Iterable[tuple[str, ...]]) -> int:
    """How many pairs of mirror images are glued neither in one step nor in neighbouring ones.

    `order` has the ids of the joints of each step, from the first to the last.
    """
    number = {name: k for k, names in enumerate(order) for name in names}
    pairs = {frozenset((name, twin)) for name in number for twin in twins[name] if twin in number}
    return sum(abs(number[one] - number[other]) > 1 for one, other in map(sorted, pairs))


def _images(line: FloatArray, middles: set[float]) -> Iterator[FloatArray]:
    """Mirror images of a line (2, 3)."""
    for middle in sorted(middles):
        yield line * [-1, 1, 1] + [2 * middle, 0, 0]
    yield line * [1, -1, 1]


def _middles(layout: Layout) -> dict[str | None, float]:
    """The middle of each mechanism along the fold, mm, by its id; that of the card by None."""
    found: dict[str | None, list[float]] = {}
    for part in layout.parts.values():
        along = part.plane.lift(np.array(part.polygon.exterior.coords))[:, 0]
        found.setdefault(part.patch.mechanism, []).extend((along.min(), along.max()))
    return {name: round(float(min(own) + max(own)) / 2, 3) for name, own in found.items()}


def _sizes(layout: Layout, joint: Joint) -> list[float]:
    """Areas of the two parts of a joint, mm^2, the smaller first."""
    return sorted(float(layout.parts[name].polygon.area) for name in joint.parts)

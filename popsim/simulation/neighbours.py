"""Which patches touch for ever: those that share a hinge line."""

from itertools import combinations

import numpy as np

from popsim.design import Design, Hinge
from popsim.geometry.arrays import BoolArray, cross

SAME_LINE = 0.05
"""mm; hinges of one patch nearer than this lie on one line."""


Lines = list[list[Hinge]]
"""Hinges on each line."""


def touching(design: Design, lines: Lines) -> BoolArray:
    """Pairs of patches that meet on one of the hinge lines of a design, in its order, shape (p, p).

    Two planes that turn about a common line meet nowhere else, so such pairs can cross in no other way than by
    turning through each other, which is measured at the hinge itself.
    """
    place = {patch.id: index for index, patch in enumerate(design.patches)}
    pairs = np.eye(len(place), dtype=bool)
    for hinges in lines:
        inside = [place[name] for hinge in hinges for name in hinge.patches]
        pairs[np.ix_(inside, inside)] = True
    return pairs


def companions(design: Design, lines: Lines) -> tuple[Hinge, ...]:
    """Pairs of patches that turn about one line and are not hinged to each other, as hinges about that line.

    Two walls on one fold line of a page, for one. Those of which one ends along the line before the other begins
    are left out. Ids are made of both patches.
    """
    found = []
    for hinges in lines:
        joined = {frozenset(hinge.patches) for hinge in hinges}
        names = sorted({name for hinge in hinges for name in hinge.patches})
        start, end = hinges[0].points
        reaches = [design.patch_by_id[name].points @ (end - start) for name in names]
        low, high = np.array([reach.min() for reach in reaches]), np.array([reach.max() for reach in reaches])
        meet = (low[:, None] < high) & (high[:, None] > low)
        for first, second in np.argwhere(np.triu(meet, 1)).tolist():
            pair = names[first], names[second]
            if frozenset(pair) not in joined:
                found.append(Hinge(id="+".join(pair), patches=pair, axis=hinges[0].axis, kind="fold"))
    return tuple(found)


def hinge_lines(design: Design) -> Lines:
    """Hinges on each line; those that share a patch and lie on one line belong together."""
    root = list(range(len(design.hinges)))

    def find(index: int) -> int:
        while root[index] != index:
            root[index] = root[root[index]]
            index = root[index]
        return index

    for one, other in _on_one_line(design):
        root[find(one)] = find(other)
    lines: dict[int, list[Hinge]] = {}
    for index, hinge in enumerate(design.hinges):
        lines.setdefault(find(index), []).append(hinge)
    return list(lines.values())


def _on_one_line(design: Design) -> list[tuple[int, int]]:
    """Pairs of hinges that share a patch and lie on one line, by their positions in the design."""
    number = {hinge.id: index for index, hinge in enumerate(design.hinges)}
    shared = [
        (number[one.id], number[other.id])
        for hinges in design.hinges_by_patch.values()
        for one, other in combinations(hinges, 2)
    ]
    if not shared:
        return []
    first, second = np.array(shared).T
    points = np.array([hinge.points for hinge in design.hinges])
    along = points[:, 1] - points[:, 0]
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    away = cross(points[first] - points[second, :1], along[second, None])
    near = np.linalg.norm(away, axis=-1).max(axis=-1) < SAME_LINE
    return [pair for pair, same in zip(shared, near.tolist(), strict=True) if same]

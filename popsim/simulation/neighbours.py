"""Which patches touch for ever: those that share a hinge line."""

import numpy as np

from popsim.design import Design, Hinge
from popsim.geometry.arrays import BoolArray
from popsim.geometry.plane import line_distance

SAME_LINE = 0.05
"""mm; hinges of one patch nearer than this lie on one line."""


def touching(design: Design) -> BoolArray:
    """Pairs of patches that meet on one hinge line, in the order of the design, shape (p, p).

    Two planes that turn about a common line meet nowhere else, so such pairs can cross in no other way than by
    turning through each other, which is measured at the hinge itself.
    """
    place = {patch.id: index for index, patch in enumerate(design.patches)}
    pairs = np.eye(len(place), dtype=bool)
    for members in _lines(design):
        inside = [place[name] for name in members]
        pairs[np.ix_(inside, inside)] = True
    return pairs


def _lines(design: Design) -> list[set[str]]:
    """Patches on each hinge line; hinges that share a patch and lie on one line belong together."""
    group = {hinge.id: index for index, hinge in enumerate(design.hinges)}
    members: dict[int, list[Hinge]] = {index: [hinge] for index, hinge in enumerate(design.hinges)}
    for hinges in design.hinges_by_patch.values():
        for index, hinge in enumerate(hinges):
            for other in hinges[:index]:
                mine, theirs = group[hinge.id], group[other.id]
                if mine != theirs and line_distance(hinge.points, other.points).max() < SAME_LINE:
                    for moved in members.pop(theirs):
                        group[moved.id] = mine
                        members[mine].append(moved)
    return [{name for hinge in hinges for name in hinge.patches} for hinges in members.values()]

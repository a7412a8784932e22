"""Flat creases go to the side to which the mechanism folds them (not in the paper: its drawings show which)."""

from collections.abc import Mapping

import numpy as np

from popsim.design import Design, Hinge
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import transform
from popsim.mechanisms import Condition


def crease_conditions(design: Design, half_closed: Mapping[str, FloatArray]) -> list[Condition]:
    """For each mechanism with creases that are flat when open: all bulge to the side that the design says.

    Parameters
    ----------
    design:
        The design. The central fold is left out: it goes where the pages go.
    half_closed:
        Motion of each recognised patch from the open pose to a fold angle of 90 degrees, where every crease is
        bent, (4, 4), by patch id.

    The margin is how far the crease stands out over the far edge of the smaller of its patches.
    """
    margins: dict[str, list[float]] = {}
    for hinge in design.hinges:
        if hinge.crease is not None and hinge.kind != "central" and half_closed.keys() >= set(hinge.patches):
            owner = design.owner.get(hinge.patches[0]) or design.owner[hinge.patches[1]]
            margins.setdefault(owner, []).append(_bulge(design, hinge, half_closed))
    name = "creases bulge to the side that is stated"
    return [Condition("foldable", owner, name, min(found)) for owner, found in margins.items()]


def _bulge(design: Design, hinge: Hinge, poses: Mapping[str, FloatArray]) -> float:
    """How far a crease stands out to its own side over the far edges of its patches: of both the less, mm."""
    heights = []
    for name, other in (hinge.patches, hinge.patches[::-1]):
        points = design.patch_by_id[other].points
        far = points[line_distance(points, hinge.points).argmax()]
        start, end = transform(poses[other], np.array([hinge.points[0], far]))
        heights.append(float((start - end) @ poses[name][:3, :3] @ np.array(hinge.crease)))
    return min(heights, key=abs)

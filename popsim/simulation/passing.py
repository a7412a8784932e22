"""Hinged patches that turn through each other, which no test of separate patches can see."""

from collections.abc import Sequence

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.simulation.contact import Contact, closing_frames, contact_of
from popsim.simulation.sweep import Sweep
from popsim.simulation.turning import Turn, turnings


def find_passing(sweep: Sweep, turns: Sequence[Turn], tolerance: float) -> list[Contact]:
    """Hinges whose patches pass each other by more than `tolerance` mm at the far edge while the card closes."""
    depths = passing_depths(sweep, turns)[: closing_frames(sweep)]
    found = []
    for turn, depth in zip(turns, depths.T, strict=True):
        if depth.max(initial=0.0) > tolerance:
            contact = contact_of(sweep, turn.hinge.patches, dict(enumerate(depth.tolist())), tolerance)
            found += [] if contact is None else [contact]
    return found


def passing_depths(sweep: Sweep, turns: Sequence[Turn]) -> FloatArray:
    """How far the two patches of each hinge have passed each other at the far edge, at each angle, mm, (n, h)."""
    if not turns:
        return np.zeros((len(sweep.theta), 0))
    hinges = [turn.hinge for turn in turns]
    first, second = (sweep.poses[:, [sweep.index[hinge.patches[side]] for hinge in hinges]] for side in (0, 1))
    angle = turnings(hinges, first, second)
    lower, upper = np.array([[turn.lower, turn.upper] for turn in turns]).T
    over = np.clip(np.maximum(lower - angle, angle - upper), 0.0, np.pi / 2)
    passed = np.flatnonzero(over.max(axis=0) > 0)
    depths = np.zeros_like(over)
    depths[:, passed] = np.sin(over[:, passed]) * [_reach(sweep, turns[column]) for column in passed]
    return depths


def _reach(sweep: Sweep, turn: Turn) -> float:
    """How far from the hinge the shorter of the two patches reaches, mm."""
    patches = [sweep.design.patch_by_id[name] for name in turn.hinge.patches]
    return min(float(line_distance(patch.points, turn.hinge.points).max()) for patch in patches)

"""Hinged patches that turn through each other, which no test of separate patches can see."""

from collections.abc import Iterable

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.simulation.contact import Contact, closing_frames, contact_of
from popsim.simulation.sweep import Sweep
from popsim.simulation.turning import Turn, turned


def find_passing(sweep: Sweep, turns: Iterable[Turn], tolerance: float) -> list[Contact]:
    """Hinges whose patches pass each other by more than `tolerance` mm at the far edge while the card closes."""
    count = closing_frames(sweep)
    found = []
    for turn in turns:
        depth = passing_depth(sweep, turn)[:count]
        contact = contact_of(sweep, turn.hinge.patches, dict(enumerate(depth.tolist())), tolerance)
        found += [] if contact is None else [contact]
    return found


def passing_depth(sweep: Sweep, turn: Turn) -> FloatArray:
    """How far the two patches of a hinge have passed each other at the far edge, at each angle, mm, shape (n,)."""
    angle = turned(turn.hinge, *(sweep.poses[:, sweep.index[name]] for name in turn.hinge.patches))
    over = np.maximum(np.maximum(turn.lower - angle, angle - turn.upper), 0.0)
    return np.asarray(np.sin(np.minimum(over, np.pi / 2)) * _reach(sweep, turn))


def _reach(sweep: Sweep, turn: Turn) -> float:
    """How far from the hinge the shorter of the two patches reaches, mm."""
    patches = [sweep.design.patch_by_id[name] for name in turn.hinge.patches]
    return min(float(line_distance(patch.points, turn.hinge.points).max()) for patch in patches)

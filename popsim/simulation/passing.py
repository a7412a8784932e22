"""Patches on one line that turn through each other, which no test of separate patches can see."""

from collections.abc import Sequence

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.plane import line_distance
from popsim.simulation.contact import Depths
from popsim.simulation.sweep import Sweep
from popsim.simulation.turning import Turn, angles_between, free_turns

BARELY = 1e-4
"""rad; planes that pass each other by less than this are face to face: 0.01 mm at 100 mm from their line."""


def find_passing(sweep: Sweep, frames: IntArray, turns: Sequence[Turn], tolerance: float) -> Depths:
    """Hinges whose patches pass each other by more than `tolerance` mm at the far edge at recorded angles (k,)."""
    depths = passing_depths(sweep, turns)[frames]
    found: Depths = {}
    for row, column in np.argwhere(depths > tolerance).tolist():
        found.setdefault(turns[column].hinge.patches, {})[int(frames[row])] = float(depths[row, column])
    return found


def turns_that_pass(sweep: Sweep) -> list[Turn]:
    """How far patches on one line without a hinge turn freely, of those whose planes pass each other.

    Most do not; that is known from their angles, long before their outlines are held against each other.
    """
    hinges = sweep.companions
    if not hinges:
        return []
    angles = angles_between(sweep.design, hinges) + sweep.turned(hinges)
    low, high = angles.min(axis=0) + BARELY, angles.max(axis=0) - BARELY
    passing = np.ceil(low / np.pi) * np.pi < high
    chosen = [hinge for hinge, passes in zip(hinges, passing, strict=True) if passes]
    return list(free_turns(sweep.design, chosen).values())


def passing_depths(sweep: Sweep, turns: Sequence[Turn]) -> FloatArray:
    """How far the two patches of each hinge have passed each other at the far edge, at each angle, mm, (n, h)."""
    if not turns:
        return np.zeros((len(sweep.theta), 0))
    angle = sweep.turned([turn.hinge for turn in turns])
    lower, upper = np.array([[turn.lower, turn.upper] for turn in turns]).T
    over: FloatArray = np.clip(np.maximum(lower - angle, angle - upper), 0.0, np.pi / 2)
    depths = np.zeros(over.shape)
    for column in np.flatnonzero(over.max(axis=0) > 0).tolist():
        depths[:, column] = np.sin(over[:, column]) * _reach(sweep, turns[column])
    return depths


def _reach(sweep: Sweep, turn: Turn) -> float:
    """How far from the hinge the shorter of the two patches reaches, mm."""
    patches = [sweep.design.patch_by_id[name] for name in turn.hinge.patches]
    return min(float(line_distance(patch.points, turn.hinge.points).max()) for patch in patches)

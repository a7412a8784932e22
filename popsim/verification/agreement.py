"""How well the simulation agrees with the closed forms of the mechanisms."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.extents import sweep_range
from popsim.simulation.sweep import Sweep
from popsim.validity import Theory
from popsim.verification.settings import Settings
from popsim.verification.verdict import Measure

COMPARED_DEGREES = (1.0, 179.0)
"""Closed forms are compared between these: at 180 and 0 poses are singular, and tiny gaps move plates far."""

Range = tuple[float, float]


def agreement(sweep: Sweep, theory: Theory, settings: Settings) -> tuple[Measure, ...]:
    """Largest deviation of poses and of closing ranges from the theory."""
    compared = [_poses(sweep, theory, settings), _ranges(sweep, theory, settings)]
    return tuple(measure for measure in compared if measure is not None)


def measured_ranges(sweep: Sweep, theory: Theory) -> dict[str, tuple[Range, Range | None]]:
    """Measured and analytic closing range of each mechanism of the design, mm."""
    records = [record for record in theory.design.mechanisms if record.patches]
    return {record.id: (sweep_range(sweep, record.patches), theory.ranges.get(record.id)) for record in records}


def distances(sweep: Sweep, theory: Theory) -> tuple[IntArray, dict[str, FloatArray]]:
    """Greatest distance of any corner of each patch from its closed form, mm, by its id, shape (k,) each.

    The first array, shape (k,), tells at which of the recorded angles: those within COMPARED_DEGREES.
    """
    low, high = COMPARED_DEGREES
    inside = np.flatnonzero((sweep.degrees > low - 1e-6) & (sweep.degrees < high + 1e-6))
    known = theory.poses(sweep.theta[inside])
    stated = sweep.poses[inside].copy()
    for name, poses in known.items():
        stated[:, sweep.index[name]] = poses
    apart = np.linalg.norm(sweep.places[inside] - sweep.corners.moved(stated), axis=-1)
    away = sweep.corners.greatest(apart)
    return inside, {name: away[:, sweep.index[name]] for name in known}


def _poses(sweep: Sweep, theory: Theory, settings: Settings) -> Measure | None:
    inside, away = distances(sweep, theory)
    worst = (-1.0, "")
    for name, distance in away.items():
        at = int(distance.argmax())
        worst = max(worst, (float(distance[at]), f"{name} at {sweep.degrees[inside[at]]:.4g} deg"))
    return None if worst[0] < 0 else Measure("distance from closed form", worst[0], settings.pose, where=worst[1])


def _ranges(sweep: Sweep, theory: Theory, settings: Settings) -> Measure | None:
    off = [
        (max(abs(found[0] - stated[0]), abs(found[1] - stated[1])), name)
        for name, (found, stated) in measured_ranges(sweep, theory).items()
        if stated is not None
    ]
    if not off:
        return None
    value, name = max(off)
    return Measure("distance from analytic closing range", value, settings.closing_range, where=name)

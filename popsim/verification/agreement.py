"""How well the simulation agrees with the closed forms of the mechanisms."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.simulation.blur import blur
from popsim.simulation.extents import sweep_range
from popsim.simulation.sweep import Sweep
from popsim.validity import Theory
from popsim.verification.evidence import Evidence
from popsim.verification.settings import Settings
from popsim.verification.verdict import Measure

COMPARED_DEGREES = (1.0, 179.0)
"""Closed forms are compared between these: at 180 and 0 poses are singular, and tiny gaps move plates far."""

Range = tuple[float, float]


EXPLAINED = 10.0
"""Times the blur of a pose that its loop gap may explain; the blur is an estimate to first order."""


def agreement(evidence: Evidence, theory: Theory, settings: Settings) -> tuple[tuple[Measure, ...], str]:
    """Largest deviation of poses and of closing ranges from the theory; and what was left out, in words, or ""."""
    poses, left_out = _poses(evidence, theory, settings)
    compared = [poses, _ranges(evidence.sweep, theory, settings)]
    return tuple(measure for measure in compared if measure is not None), left_out


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
    theta, both_ways = np.unique(sweep.theta[inside], return_inverse=True)
    known = theory.poses(theta)
    stated = sweep.poses[inside].copy()
    for name, poses in known.items():
        stated[:, sweep.index[name]] = poses[both_ways]
    apart = np.linalg.norm(sweep.places[inside] - sweep.corners.moved(stated), axis=-1)
    away = sweep.corners.greatest(apart)
    return inside, {name: away[:, sweep.index[name]] for name in known}


def _poses(evidence: Evidence, theory: Theory, settings: Settings) -> tuple[Measure | None, str]:
    """Largest deviation, where the gap that is left in the loops is too small to explain it.

    A pose that its loops do not determine to the tolerance proves nothing, unless it is off by far more than that.
    """
    sweep = evidence.sweep
    inside, away = distances(sweep, theory)
    if not away or not len(inside):
        return None, ""
    apart = np.array(list(away.values()))
    off = np.flatnonzero(apart.max(axis=0) > settings.pose)
    blurred = blur(evidence.rig, sweep, inside[off])
    vague = off[(blurred > settings.pose) & (apart.max(axis=0)[off] <= EXPLAINED * blurred)]
    kept = np.delete(np.arange(len(inside)), vague)
    if not len(kept):
        return None, _left_out(sweep, inside[vague], apart[:, vague])
    patch, place = np.unravel_index(int(apart[:, kept].argmax()), (len(apart), len(kept)))
    at = kept[place]
    where = f"{list(away)[patch]} at {sweep.degrees[inside[at]]:.4g} deg"
    measure = Measure("distance from closed form", float(apart[patch, at]), settings.pose, where=where)
    return measure, _left_out(sweep, inside[vague], apart[:, vague])


def _left_out(sweep: Sweep, frames: IntArray, apart: FloatArray) -> str:
    if not len(frames):
        return ""
    low, high = sweep.degrees[frames].min(), sweep.degrees[frames].max()
    return (
        f"poses at {len(frames)} angles from {low:.4g} to {high:.4g} deg are not compared with the closed forms: "
        f"they are up to {apart.max():.2g} mm off, and the structure is so soft there that its loops do not tell"
    )


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

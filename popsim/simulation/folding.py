"""Folding a design, briskly first and patiently where that leaves a gap."""

from dataclasses import dataclass

import numpy as np

from popsim.design import Design
from popsim.simulation.gaps import Gaps, loop_gaps
from popsim.simulation.passing import passing_depths
from popsim.simulation.polish import polished
from popsim.simulation.rig import Rig
from popsim.simulation.solver import BRISK, PATIENT, Pacing
from popsim.simulation.sweep import Sweep, fold

CLOSES = 1e-3
"""mm; a largest gap up to this needs no second, patient sweep."""

PASSED = 0.05
"""mm; hinged patches that pass each other by more have gone where paper cannot."""


@dataclass(frozen=True, eq=False)
class Folding:
    """A design that was folded: its rig, the recorded motion and the gaps left in it."""

    rig: Rig
    sweep: Sweep
    gaps: Gaps


def fold_design(design: Design, angles: int) -> Folding:
    """Close and open `design`, recording `angles` equal steps each way.

    Of two sweeps the one with the smaller gap counts: poses in which the loops close prove that they can.
    """
    brisk = _fold(design, angles, BRISK)
    if brisk.sweep.complete and brisk.gaps.largest <= CLOSES:
        return brisk
    patient = _fold(design, angles, PATIENT)
    return min(brisk, patient, key=lambda folding: (not folding.sweep.complete, folding.gaps.largest))


def _fold(design: Design, angles: int, pacing: Pacing) -> Folding:
    """Fold until no hinge passes through itself, or all such hinges are joints with limits.

    Closed, a parallelogram can open to either side; one of them takes patches through each other. Paper stops
    there, and so does a joint of the forest, but not a hinge that closes a loop.
    """
    guarded: frozenset[str] = frozenset()
    while True:
        folding = _fold_once(design, angles, pacing, guarded)
        loops = folding.rig.forest.loops
        depths = passing_depths(folding.sweep, [folding.rig.turns[hinge.id] for hinge in loops])
        passed = {loops[column].id for column in np.flatnonzero(depths.max(axis=0) > PASSED)}
        if passed <= guarded or not folding.sweep.complete:
            return folding
        guarded |= passed


def _fold_once(design: Design, angles: int, pacing: Pacing, guarded: frozenset[str]) -> Folding:
    rig = Rig(design, pacing, guarded)
    sweep = polished(rig, fold(rig, angles, pacing))
    return Folding(rig, sweep, loop_gaps(sweep, rig.forest.loops))

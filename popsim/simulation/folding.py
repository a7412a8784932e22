"""Folding a design, briskly first and patiently where that leaves a gap."""

from dataclasses import dataclass

from popsim.design import Design
from popsim.simulation.gaps import Gaps, loop_gaps
from popsim.simulation.polish import polished
from popsim.simulation.rig import Rig
from popsim.simulation.solver import BRISK, PATIENT, Pacing
from popsim.simulation.sweep import Sweep, fold

CLOSES = 1e-3
"""mm; a largest gap up to this needs no second, patient sweep."""


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
    rig = Rig(design, pacing)
    sweep = polished(rig, fold(rig, angles, pacing))
    return Folding(rig, sweep, loop_gaps(sweep, rig.forest.loops))

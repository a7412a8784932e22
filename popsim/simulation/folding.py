"""Folding a design, briskly first and more slowly where that leaves a gap."""

from dataclasses import dataclass
from functools import cached_property

from popsim.design import Design
from popsim.simulation.gaps import Gaps, loop_gaps
from popsim.simulation.passing import passing_depths
from popsim.simulation.polish import polished
from popsim.simulation.rig import Rig
from popsim.simulation.solver import BRISK, PATIENT, STEADY, Pacing
from popsim.simulation.sweep import Sweep, fold

CLOSES = 1e-3
"""mm; a largest gap up to this needs no second, slower sweep."""

PASSED = 1e-3
"""mm; hinged patches that pass each other by more than this and the gap have gone where paper cannot. A thin
parallelogram that opens crosswise passes itself by hundredths of a mm only, and carries others far off."""

ROUNDS = 4
"""Sweeps in which ever more hinges are guarded. What passes after the last is told as a crossing."""


@dataclass(frozen=True, eq=False)
class Folding:
    """A design that was folded: its rig, the recorded motion and the gaps left in it."""

    rig: Rig
    sweep: Sweep
    gaps: Gaps

    @cached_property
    def passed(self) -> frozenset[str]:
        """Ids of the hinges that close loops and pass through themselves."""
        loops = self.rig.forest.loops
        depths = passing_depths(self.sweep, [self.rig.turns[hinge.id] for hinge in loops])
        through = depths.max(axis=0, initial=0.0) > PASSED + self.gaps.largest
        return frozenset(hinge.id for hinge, passes in zip(loops, through, strict=True) if passes)

    @property
    def badness(self) -> tuple[bool, bool, float]:
        """The sweep with the least counts: complete, through no hinge, with the smaller gap."""
        return not self.sweep.complete, bool(self.passed), self.gaps.largest


def fold_design(design: Design, angles: int) -> Folding:
    """Close and open `design`, recording `angles` equal steps each way.

    Where a brisk sweep leaves a gap, slower ones follow, and the best of them counts: poses in which the loops
    close prove that they can.
    """
    tried = []
    for pacing in (BRISK, STEADY, PATIENT):
        tried.append(_fold(design, angles, pacing))
        if tried[-1].sweep.complete and tried[-1].gaps.largest <= CLOSES:
            return tried[-1]
    return min(tried, key=lambda folding: folding.badness)


def _fold(design: Design, angles: int, pacing: Pacing) -> Folding:
    """Fold until no hinge passes through itself, or all such hinges are joints with limits.

    Closed, a parallelogram can open to either side; one of them takes patches through each other. Paper stops
    there, and so does a joint of the forest, but not a hinge that closes a loop.
    """
    guarded: frozenset[str] = frozenset()
    folding = _fold_once(design, angles, pacing, guarded)
    for _ in range(ROUNDS):
        if folding.passed <= guarded or not folding.sweep.complete:
            break
        guarded |= folding.passed
        folding = _fold_once(design, angles, pacing, guarded)
    return folding


def _fold_once(design: Design, angles: int, pacing: Pacing, guarded: frozenset[str]) -> Folding:
    rig = Rig(design, pacing, guarded)
    sweep = polished(rig, fold(rig, angles, pacing))
    return Folding(rig, sweep, loop_gaps(sweep, rig.forest.loops))

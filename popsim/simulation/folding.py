"""Folding a design, in strides first and more slowly where that leaves a gap."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from popsim.design import Design
from popsim.simulation.extents import flatness, reopening
from popsim.simulation.gaps import Gaps, loop_gaps
from popsim.simulation.passing import passing_depths
from popsim.simulation.polish import polished
from popsim.simulation.rig import Rig
from popsim.simulation.schedule import schedule_of
from popsim.simulation.solver import BRISK, PATIENT, STEADY, SWIFT, Pacing
from popsim.simulation.stability import free_motions
from popsim.simulation.sweep import Sweep, fold
from popsim.simulation.turning import Turn, turns_of

CLOSES = 1e-3
"""mm; a largest gap up to this needs no second, slower sweep."""

PASSED = 1e-3
"""mm; hinged patches that pass each other by more than this and the gap have gone where paper cannot. A thin
parallelogram that opens crosswise passes itself by hundredths of a mm only, and carries others far off."""

STRAYED = 0.01
"""mm; a swift sweep after which the closed card is less flat, or the open one farther off its first pose, has not
told what the design does. Sound designs come back to within 0.002 mm."""

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
    def closes(self) -> bool:
        """Whether the loops close all the way."""
        return self.sweep.complete and self.gaps.largest <= CLOSES

    @property
    def faultless(self) -> bool:
        """Whether they do, no hinge passes itself, the closed card is flat, and it opens to where it was."""
        return (
            self.closes
            and not self.passed
            and max(flatness(self.sweep).value, reopening(self.sweep).value) <= STRAYED
        )

    @property
    def loose(self) -> bool:
        """Whether the loops close and something moves freely: then where it passes and ends up is chance."""
        return self.closes and any(
            motion.count for motion in free_motions(self.rig, self.sweep, self.gaps.by_angle <= CLOSES)
        )

    @property
    def badness(self) -> tuple[bool, bool, float]:
        """The sweep with the least counts: complete, through no hinge, with the smaller gap."""
        return not self.sweep.complete, bool(self.passed), self.gaps.largest


def fold_design(design: Design, angles: int) -> Folding:
    """Close and open `design`, recording `angles` equal steps each way.

    Where a brisk sweep leaves a gap, slower ones follow, and the best of them counts: poses in which the loops
    close prove that they can. A swift sweep, where it is quicker, counts only if there is no fault in it: then its
    poses are exact too. What is refused is refused after the other sweeps alone.
    """
    turns = turns_of(design)
    if schedule_of(angles, SWIFT).total_steps < schedule_of(angles, BRISK).total_steps:
        folding = _fold_once(design, angles, SWIFT, turns, frozenset())
        if folding.faultless:
            return folding
    tried = []
    for pacing in (BRISK, STEADY, PATIENT):
        tried.append(_fold(design, angles, pacing, turns))
        if tried[-1].closes:
            return tried[-1]
    return min(tried, key=lambda folding: folding.badness)


def _fold(design: Design, angles: int, pacing: Pacing, turns: Mapping[str, Turn]) -> Folding:
    """Fold until no hinge passes through itself, or all such hinges are joints with limits.

    Closed, a parallelogram can open to either side; one of them takes patches through each other. Paper stops
    there, and so does a joint of the forest, but not a hinge that closes a loop.
    """
    guarded: frozenset[str] = frozenset()
    folding = _fold_once(design, angles, pacing, turns, guarded)
    for _ in range(ROUNDS):
        if not folding.sweep.complete or folding.passed <= guarded or folding.loose:
            break
        guarded |= folding.passed
        folding = _fold_once(design, angles, pacing, turns, guarded)
    return folding


def _fold_once(
    design: Design, angles: int, pacing: Pacing, turns: Mapping[str, Turn], guarded: frozenset[str]
) -> Folding:
    """One sweep; one that broke down is not polished, because no pose of it counts."""
    rig = Rig(design, pacing, guarded, turns)
    sweep = fold(rig, angles, pacing)
    if sweep.complete:
        sweep = polished(rig, sweep)
    return Folding(rig, sweep, loop_gaps(sweep, rig.forest.loops))

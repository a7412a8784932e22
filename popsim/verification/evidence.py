"""Everything that is measured before anything is judged."""

from dataclasses import dataclass

import numpy as np

from popsim.design import Design
from popsim.simulation.contact import Contact
from popsim.simulation.extents import Farthest, flatness, protrusion, reopening
from popsim.simulation.folding import fold_design
from popsim.simulation.gaps import Gaps
from popsim.simulation.rig import Rig
from popsim.simulation.search import find_contacts
from popsim.simulation.stability import FreeMotions, Push, free_motions, push_test
from popsim.simulation.sweep import Sweep
from popsim.verification.settings import Settings


@dataclass(frozen=True, eq=False)
class Evidence:
    """Measurements of one design.

    Attributes
    ----------
    rig, sweep, gaps:
        What was folded, the recorded motion, and the loop gaps in it.
    free:
        Free motions with the pages held, at angles at which the loops close.
    pushes:
        Finite tests with the pages held; empty where loops do not close at every angle.
    flat, reopened, protruding:
        Greatest lengths over all patches; None where the motion ends early.
    contacts:
        Patches that cross, the deepest first; not looked for where something moves freely.
    """

    rig: Rig
    sweep: Sweep
    gaps: Gaps
    free: tuple[FreeMotions, ...] = ()
    pushes: tuple[Push, ...] = ()
    flat: Farthest | None = None
    reopened: Farthest | None = None
    protruding: Farthest | None = None
    contacts: tuple[Contact, ...] = ()

    @property
    def scale(self) -> float:
        """Size of the pop-up, mm."""
        return self.rig.scale

    @property
    def free_count(self) -> int:
        """Free motions; at the angle with fewest, where there are any: a pose may happen to be singular too."""
        return min((motion.count for motion in self.free if motion.count), default=0)


def gather(design: Design, settings: Settings) -> Evidence:
    """Fold `design` and measure."""
    folding = fold_design(design, settings.angles)
    rig, sweep, gaps = folding.rig, folding.sweep, folding.gaps
    free = tuple(free_motions(rig, sweep, gaps.by_angle <= settings.play))
    if not sweep.complete or not gaps.largest <= settings.play:
        return Evidence(rig, sweep, gaps, free)
    loose = any(motion.count for motion in free)
    return Evidence(
        rig=rig,
        sweep=sweep,
        gaps=gaps,
        free=free,
        pushes=tuple(push_test(rig, sweep, np.inf if loose else settings.pushed * rig.scale)),
        flat=flatness(sweep),
        reopened=reopening(sweep),
        protruding=protrusion(sweep),
        contacts=()
        if loose
        else find_contacts(rig, sweep, settings.crossing, play=gaps.largest, resolution=settings.first_contact),
    )

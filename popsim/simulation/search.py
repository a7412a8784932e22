"""Everything that crosses in a recorded motion, and the fold angle at which it begins."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from popsim.geometry.arrays import IntArray
from popsim.simulation.collisions import find_crossings
from popsim.simulation.contact import Contact, Depths, contacts_of, searched_frames
from popsim.simulation.passing import find_passing, turns_that_pass
from popsim.simulation.piercing import find_piercings
from popsim.simulation.polish import inserted
from popsim.simulation.rig import Rig
from popsim.simulation.sweep import Sweep

PARTS = 10
"""Into how many steps the one between two angles is divided when a contact is looked for between them."""

BACK = 10
"""Earlier angles that are looked at too: what changes sides may lie in one plane for some."""

ALIKE = 6
"""Decimals of depths, mm, that tell contacts apart; those of mirror images differ in the last bits only."""

SAME = 1e-6
"""Share of a step that rounding may make it longer."""


Look = Callable[[Sweep, IntArray], tuple[Depths, ...]]
"""Depths of each kind of crossing in a motion at some of its recorded angles (k,)."""

Crossing = tuple[int, tuple[str, str]]
"""Kind and patches of a crossing."""


def find_contacts(
    rig: Rig, sweep: Sweep, tolerance: float, *, play: float, resolution: float
) -> tuple[Contact, ...]:
    """All pairs of patches that cross, the deepest first.

    Parameters
    ----------
    rig, sweep:
        What was folded, and its motion.
    tolerance:
        mm; what crosses by less only touches.
    play:
        Largest loop gap, mm: poses are no more exact than that.
    resolution:
        Degrees; how exactly the angles are told at which contacts begin. Steps of the sweep are divided until they
        are no longer than that.
    """

    def look(motion: Sweep, frames: IntArray) -> tuple[Depths, ...]:
        turns = [*rig.turns.values(), *turns_that_pass(motion)]
        return (
            find_crossings(motion, frames, tolerance),
            find_piercings(motion, frames, tolerance, play),
            find_passing(motion, frames, turns, tolerance),
        )

    known: dict[tuple[int, int], list[Contact]] = {}
    for kind, depths in enumerate(look(sweep, searched_frames(sweep, tolerance))):
        for contact in contacts_of(sweep, depths):
            known.setdefault((kind, contact.frame), []).append(contact)
    contacts = []
    for (kind, frame), starting in known.items():
        wanted = {(kind, contact.patches) for contact in starting}
        first = _beginnings(rig, sweep, frame, wanted, look, resolution)
        contacts += [replace(contact, first=first[kind, contact.patches]) for contact in starting]
    return tuple(sorted(contacts, key=lambda contact: (-round(contact.depth, ALIKE), contact.patches)))


def _beginnings(
    rig: Rig, sweep: Sweep, frame: int, wanted: set[Crossing], look: Look, resolution: float
) -> dict[Crossing, float]:
    """Fold angles at which crossings begin that are found at `frame` and not at the recorded angle before, rad."""
    step = 0.0 if frame == 0 else abs(sweep.degrees[frame] - sweep.degrees[frame - 1])
    if step <= resolution * (1 + SAME):
        return dict.fromkeys(wanted, float(sweep.theta[frame]))
    finer = inserted(rig, sweep, frame - 1, PARTS)
    last = frame + PARTS - 1
    found = look(finer, np.arange(max(frame - BACK, 0), last))
    begins: dict[int, set[Crossing]] = defaultdict(set)
    for kind, patches in wanted:
        later = [place for place in found[kind].get(patches, {}) if place >= frame]
        begins[min(later, default=last)].add((kind, patches))
    first: dict[Crossing, float] = {}
    for place, crossings in begins.items():
        first |= _beginnings(rig, finer, place, crossings, look, resolution)
    return first

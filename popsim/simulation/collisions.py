"""Plates that cross."""

from collections import defaultdict

import numpy as np

from popsim.geometry.arrays import IntArray
from popsim.simulation.candidates import Candidate, pairs_and_changes
from popsim.simulation.changing import changed_through
from popsim.simulation.contact import Depths
from popsim.simulation.plates import prisms
from popsim.simulation.scene import Scene
from popsim.simulation.sweep import Sweep

SKIN = 1e-4
"""Half thickness of the plates that MuJoCo collides, over the extent of the scene: it wants volume. Depths are
corrected by it."""


def find_crossings(sweep: Sweep, frames: IntArray, tolerance: float) -> Depths:
    """All pairs of patches that cross by more than `tolerance` mm at recorded angles (k,).

    Depths are those of MuJoCo's convex collision: the least shift that would part the deepest pieces. Of patches
    that changed sides at once it is how deep one lies within the outline of the other.
    """
    candidates, changes = pairs_and_changes(sweep, frames, tolerance)
    found = _reaching(sweep, candidates, tolerance) if candidates else {}
    for change in changes:
        depth = changed_through(sweep, change)
        if depth > tolerance:
            first, second = (sweep.design.patches[k].id for k in sorted(change.pair))
            found.setdefault((first, second), {}).setdefault(change.after, depth)
    return found


def _reaching(sweep: Sweep, candidates: list[Candidate], tolerance: float) -> Depths:
    """Depths of the candidates that reach through each other by more than `tolerance` mm."""
    members = sorted({k for candidate in candidates for k in candidate.pair})
    patches = sweep.design.patches
    scale = float(np.ptp(np.concatenate([patches[k].points for k in members]), axis=0).max())
    scene = Scene({k: prisms(patches[k], scale, SKIN) for k in members}, scale)
    by_angle: dict[int, list[Candidate]] = defaultdict(list)
    for candidate in candidates:
        for angle in candidate.angles:
            by_angle[angle].append(candidate)
    found: Depths = {}
    for angle, pairs in sorted(by_angle.items()):
        scene.place(sweep.poses[angle])
        for candidate in pairs:
            depth = -(scene.distance(*candidate.pair, SKIN * scale) + 2 * SKIN * scale)
            if depth > tolerance:
                first, second = (patches[k].id for k in candidate.pair)
                found.setdefault((first, second), {})[angle] = depth
    return found

"""Plates that cross while the card closes."""

from collections import defaultdict

import numpy as np

from popsim.simulation.candidates import Candidate, candidate_pairs
from popsim.simulation.contact import Contact, closing_frames, contact_of
from popsim.simulation.plates import prisms
from popsim.simulation.scene import Scene
from popsim.simulation.sweep import Sweep

SKIN = 1e-4
"""Half thickness of the plates that MuJoCo collides, over the extent of the scene: it wants volume. Depths are
corrected by it."""


def find_crossings(sweep: Sweep, tolerance: float) -> list[Contact]:
    """All pairs of patches that cross by more than `tolerance` mm while the card closes.

    Depths are those of MuJoCo's convex collision: the least shift that would part the deepest pieces.
    """
    candidates = candidate_pairs(sweep, range(closing_frames(sweep)), tolerance)
    if not candidates:
        return []
    depths = _depths(sweep, candidates)
    names = [patch.id for patch in sweep.design.patches]
    found = [
        contact_of(sweep, (names[one.first], names[one.second]), depths[one.first, one.second], tolerance)
        for one in candidates
    ]
    return [contact for contact in found if contact is not None]


def _depths(sweep: Sweep, candidates: list[Candidate]) -> dict[tuple[int, int], dict[int, float]]:
    """Depth in mm by pair and position of the angle; absent where they are apart."""
    members = sorted({k for c in candidates for k in (c.first, c.second)})
    patches = [sweep.design.patches[k] for k in members]
    scale = float(np.ptp(np.concatenate([patch.points for patch in patches]), axis=0).max())
    scene = Scene({k: prisms(patch, scale, SKIN) for k, patch in zip(members, patches, strict=True)}, scale)
    by_angle: dict[int, list[Candidate]] = defaultdict(list)
    for candidate in candidates:
        for angle in candidate.angles:
            by_angle[angle].append(candidate)
    depths: dict[tuple[int, int], dict[int, float]] = defaultdict(dict)
    for angle, pairs in sorted(by_angle.items()):
        scene.place(sweep.poses[angle])
        for candidate in pairs:
            pair = (candidate.first, candidate.second)
            depths[pair][angle] = -(scene.distance(*pair, SKIN * scale) + 2 * SKIN * scale)
    return depths

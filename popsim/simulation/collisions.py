"""Plates that cross while the card closes."""

from collections import defaultdict
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.simulation.candidates import Candidate, candidate_pairs
from popsim.simulation.contact import Contact, closing_frames, contact_of
from popsim.simulation.engine import load_mujoco
from popsim.simulation.plates import mesh_assets, mesh_geoms, prisms
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
    scene = _Scene(sweep, sorted({k for c in candidates for k in (c.first, c.second)}))
    by_angle: dict[int, list[Candidate]] = defaultdict(list)
    for candidate in candidates:
        for angle in candidate.angles:
            by_angle[angle].append(candidate)
    depths: dict[tuple[int, int], dict[int, float]] = defaultdict(dict)
    for angle, pairs in sorted(by_angle.items()):
        scene.place(sweep.poses[angle])
        for candidate in pairs:
            pair = (candidate.first, candidate.second)
            depths[pair][angle] = scene.depth(*pair)
    return depths


class _Scene:
    """Some patches of a design as thin convex prisms on mocap bodies."""

    def __init__(self, sweep: Sweep, members: list[int]) -> None:
        self._mujoco = mujoco = load_mujoco()
        self._members = members
        patches = [sweep.design.patches[k] for k in members]
        points = np.concatenate([patch.points for patch in patches])
        self._scale = float(np.ptp(points, axis=0).max())
        parts = [prisms(patch, self._scale, SKIN) for patch in patches]
        counts = np.cumsum([0, *(len(part) for part in parts)])
        self._geoms = {k: range(counts[i], counts[i + 1]) for i, k in enumerate(members)}
        self._model: Any = mujoco.MjModel.from_xml_string(_scene_mjcf(patches, parts))
        self._data: Any = mujoco.MjData(self._model)
        self._segment = np.zeros(6)

    def place(self, poses: FloatArray) -> None:
        """Put the patches where `poses` (p, 4, 4) say."""
        for body, member in enumerate(self._members):
            self._mujoco.mju_mat2Quat(self._data.mocap_quat[body], poses[member, :3, :3].ravel())
            self._data.mocap_pos[body] = poses[member, :3, 3] / self._scale
        self._mujoco.mj_kinematics(self._model, self._data)

    def depth(self, first: int, second: int) -> float:
        """How far two patches reach through each other, mm: of their deepest pieces; at most 0 where apart."""
        nearest = min(
            self._mujoco.mj_geomDistance(self._model, self._data, one, other, SKIN, self._segment)
            for one in self._geoms[first]
            for other in self._geoms[second]
        )
        return float(-(nearest + 2 * SKIN) * self._scale)


def _scene_mjcf(patches: list[Patch], parts: list[list[FloatArray]]) -> str:
    meshes, bodies, count = [], [], 0
    for patch, pieces in zip(patches, parts, strict=True):
        meshes.append(mesh_assets(count, pieces))
        bodies.append(f'<body name={quoteattr(patch.id)} mocap="true">{mesh_geoms(count, pieces)}</body>')
        count += len(pieces)
    return (
        f'<mujoco model="plates"><asset>{"".join(meshes)}</asset><worldbody>{"".join(bodies)}</worldbody></mujoco>'
    )

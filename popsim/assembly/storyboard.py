"""What lies on the table before and after a step, from what was proved of it."""

from collections.abc import Mapping

import numpy as np

from popsim.assembly.flap_motion import FlapMotion
from popsim.assembly.glueing import Glueing
from popsim.assembly.kit import Kit
from popsim.assembly.pose_on_table import on_table
from popsim.assembly.proof import Proof
from popsim.assembly.scene import Scene
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN

Poses = Mapping[str, FloatArray]


def scenes(kit: Kit, proof: Proof, made: frozenset[str]) -> tuple[Scene, Scene, dict[str, FloatArray]]:
    """Scenes before and after a step, and how its movers move; `made` are the ids of the joints made before it."""
    together = proof.together
    glueing = Glueing(kit, proof.joints)
    table = on_table(kit.layout, together, glueing.spots(glueing.flaps[0], together)[0], proof.up)
    motion = {name: table @ poses for name, poses in proof.motion.items()}
    first, last = ({name: poses[k] for name, poses in motion.items()} for k in (0, -1))
    before = _scene(kit, first, last, made, frozenset(proof.joints))
    after = _scene(kit, last, last, made | set(proof.joints), frozenset())
    return before, after, {name: motion[name] for name in sorted(proof.movers)}


def finished(kit: Kit) -> Scene:
    """The finished pop-up, open."""
    poses = {name: np.eye(4) for name in kit.layout.parts}
    return _scene(kit, poses, poses, frozenset(kit.flaps_of), frozenset())


def _scene(kit: Kit, poses: Poses, together: Poses, made: frozenset[str], now: frozenset[str]) -> Scene:
    """Parts at `poses`; flaps of joints `made` lie on their targets, those glued `now` are folded for it."""
    flaps = {
        key: _flap(motion, poses, together, made, now)
        for key, motion in kit.flap_motions.items()
        if motion.flap.carrier in poses
    }
    return Scene(poses, flaps, _card_angle(kit, poses))


def _flap(
    motion: FlapMotion, poses: Poses, together: Poses, made: frozenset[str], now: frozenset[str]
) -> FloatArray:
    flap = motion.flap
    glued = motion.landed
    if flap.joint.id in made:
        return np.asarray(poses[flap.target] @ glued)
    if flap.joint.id in now:
        carried = poses[flap.carrier] @ np.linalg.inv(together[flap.carrier])
        return np.asarray(carried @ together[flap.target] @ glued)
    return poses[flap.carrier]


def _card_angle(kit: Kit, poses: Poses) -> float | None:
    """Fold angle of the card, rad, where both pages are there."""
    pages = []
    for page in (GROUND_ID, BACKDROP_ID):
        names = [name for name in poses if kit.layout.parts[name].patch.id == page]
        pages += names[:1]
    if len(pages) < 2:
        return None
    turn = (np.linalg.inv(poses[pages[0]]) @ poses[pages[1]])[:3, :3]
    return float(OPEN - abs(np.arctan2(turn[2, 1], turn[1, 1])))

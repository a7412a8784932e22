"""The joints of one step: where their flaps land, what is seen of them, which finger gets there."""

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from popsim.assembly.kit import Kit
from popsim.assembly.pose_on_table import heights
from popsim.assembly.scene import flap_key
from popsim.assembly.sight import HIDDEN, Surroundings
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.layout import Flap

LEVEL = 2.0
"""mm; what sticks out of a plane by less lies flat in it: paper gives, and loops have that much play at most."""

Poses = Mapping[str, FloatArray]


class Glueing:
    """Joints that are made in one step."""

    def __init__(self, kit: Kit, joints: Iterable[str]) -> None:
        self.kit = kit
        self.joints = tuple(joints)
        self.flaps = tuple(flap for name in self.joints for flap in kit.flaps_of[name])

    def face(self, flap: Flap, poses: Poses) -> FloatArray:
        """Unit normal out of the face on which a flap lands, (3,)."""
        return np.asarray(poses[flap.target][:3, :3] @ self.kit.face(flap))

    def unseen(self, together: Poses, apart: Poses) -> tuple[str, ...]:
        """Joints of which neither glue area can be seen while their sides are `apart`."""
        around = Surroundings(self.kit.outlines, apart)
        return tuple(
            name
            for name in self.joints
            if all(self._openness(flap, together, apart, around) < HIDDEN for flap in self.kit.flaps_of[name])
        )

    def unreached(self, poses: Poses) -> tuple[str, ...]:
        """The two parts of a flap that no pair of fingers can press from both sides; empty if there is none."""
        around = Surroundings(self.kit.outlines, poses)
        for flap in self.flaps:
            spots, normals = self.spots(flap, poses), self._normals(flap, poses)
            backed = self._on_table(poses, spots[0], normals[0]) or around.reached(spots, -normals)
            if not (backed and around.reached(spots, normals)):
                return flap.carrier, flap.target
        return ()

    def gets_glue(self, poses: Poses) -> bool:
        """Whether a stick with glue on it gets to all landings."""
        around = Surroundings(self.kit.outlines, poses)
        return all(around.glued(self.spots(flap, poses), self._normals(flap, poses)) for flap in self.flaps)

    def spots(self, flap: Flap, poses: Poses) -> FloatArray:
        """Places on a landing where it is pressed, shape (3, 3)."""
        return transform(poses[flap.target], self.kit.spots[flap_key(flap)])

    def covered(self, poses: Poses) -> tuple[str, ...]:
        """Joints whose landing cannot be seen."""
        around = Surroundings(self.kit.outlines, poses)
        return tuple(
            flap.joint.id
            for flap in self.flaps
            if around.openness(self.spots(flap, poses), self._normals(flap, poses)) < HIDDEN
        )

    def _normals(self, flap: Flap, poses: Poses) -> FloatArray:
        """The normal of a landing once for each spot, shape (3, 3)."""
        return np.repeat(self.face(flap, poses)[None], 3, axis=0)

    def _openness(self, flap: Flap, together: Poses, apart: Poses, around: Surroundings) -> float:
        """How well the landing can be seen, or the glued side of the flap, whichever is better."""
        return max(around.openness(spots, normals) for spots, normals in self._sides(flap, together, apart))

    def _sides(self, flap: Flap, together: Poses, apart: Poses) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Spots and unit normals, both (3, 3), of the landing of a flap and of its glued side."""
        spots, normal = self.kit.spots[flap_key(flap)], self.kit.face(flap)
        glued = np.linalg.inv(together[flap.carrier]) @ together[flap.target]
        for pose, sign in ((apart[flap.target], 1.0), (apart[flap.carrier] @ glued, -1.0)):
            yield transform(pose, spots), np.repeat((sign * pose[:3, :3] @ normal)[None], len(spots), axis=0)

    def _on_table(self, poses: Poses, spot: FloatArray, up: FloatArray) -> bool:
        return all(
            heights(self.kit.outlines[name].points, pose, spot, up).min() > -LEVEL for name, pose in poses.items()
        )

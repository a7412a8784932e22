"""What hangs together at one moment of taking the pop-up apart, and how it lies."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from popsim.assembly.kit import Kit
from popsim.assembly.reference import STACKED
from popsim.assembly.roll import groups
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform, translation
from popsim.layout import Joint

Sheet = tuple[int, ...]
"""Parts with the same value lie to each other as in the folded pop-up; what was swung aside has another one."""


@dataclass(frozen=True, eq=False)
class Bundle:
    """Parts that hang together by joints.

    Attributes
    ----------
    kit:
        What is taken apart.
    poses:
        Motion of each part from the open pose to where it lies, by part id, each of shape (4, 4).
    joints:
        The joints between them, by id, glued ones and creases.
    sheets:
        The sheet of each part, by its id.
    """

    kit: Kit
    poses: Mapping[str, FloatArray]
    joints: Mapping[str, Joint]
    sheets: Mapping[str, Sheet]

    @staticmethod
    def whole(kit: Kit) -> "Bundle":
        """The finished pop-up, folded."""
        return Bundle(kit, kit.reference.flat, kit.joints, dict.fromkeys(kit.layout.parts, ()))

    @cached_property
    def parts(self) -> frozenset[str]:
        """Ids of its parts."""
        return frozenset(self.poses)

    @property
    def glued(self) -> tuple[str, ...]:
        """Ids of its glue joints, in the order of the layout."""
        return tuple(name for name in self.joints if name in self.kit.flaps_of)

    def turn(self, part: str) -> FloatArray:
        """How the sheet in which a part lies is turned against the folded pop-up, shape (3, 3)."""
        return np.asarray((self.poses[part] @ np.linalg.inv(self.kit.reference.flat[part]))[:3, :3])

    def up(self, part: str) -> FloatArray:
        """Across the stack in which a part lies, from the backdrop to the ground, unit, shape (3,)."""
        return np.asarray(self.turn(part) @ STACKED)

    def normal(self, part: str) -> FloatArray:
        """Out of the printed side of a part, unit, shape (3,)."""
        return np.asarray(self.poses[part][:3, :3] @ self.kit.layout.parts[part].plane.normal)

    def axis(self, joint: Joint) -> FloatArray:
        """Ends of the line of a joint as it lies now, shape (2, 3)."""
        return transform(self.poses[joint.parts[0]], self.kit.ends[joint.id])

    def middle(self, parts: Collection[str]) -> FloatArray:
        """Mean of the points of some parts, shape (3,)."""
        points = [transform(self.poses[name], self.kit.outlines[name].points) for name in sorted(parts)]
        return np.asarray(np.concatenate(points).mean(axis=0))

    def lighter(self, parts: frozenset[str]) -> frozenset[str]:
        """Of some parts and all others those that are moved by hand: not the card, else the fewer."""
        sides = (parts, self.parts - parts)
        return min(sides, key=lambda side: (self.kit.ground(side) is not None, len(side), sorted(side)))

    def shifted(self, parts: Collection[str], shift: FloatArray) -> dict[str, FloatArray]:
        """Poses with some parts shifted by (3,), mm."""
        motion = translation(shift)
        return {name: motion @ pose if name in parts else pose for name, pose in self.poses.items()}

    @cached_property
    def near(self) -> list[int]:
        """What is joined to each part, as masks of the kit's roll."""
        ends = [joint.parts for joint in self.joints.values()]
        return self.kit.roll.relation(ends + [(second, first) for first, second in ends])

    def groups(self, among: Collection[str], without: Collection[str] = ()) -> list[frozenset[str]]:
        """Parts of `among` that hang together by joints other than those `without`, the largest group first."""
        roll = self.kit.roll
        near = self.without(without).near if without else self.near
        found = groups(roll.mask(self.parts.intersection(among)), near)
        return [roll.names(group) for group in sorted(found, key=int.bit_count, reverse=True)]

    def crossing(self, moved: Collection[str]) -> tuple[Joint, ...]:
        """Joints between some parts and the others."""
        return tuple(
            joint for joint in self.joints.values() if (joint.parts[0] in moved) != (joint.parts[1] in moved)
        )

    def only(self, parts: Collection[str]) -> "Bundle":
        """Some of the parts, with the joints between them."""
        return Bundle(
            self.kit,
            {name: pose for name, pose in self.poses.items() if name in parts},
            {name: joint for name, joint in self.joints.items() if set(joint.parts) <= set(parts)},
            {name: sheet for name, sheet in self.sheets.items() if name in parts},
        )

    def without(self, joints: Collection[str]) -> "Bundle":
        """The same without some joints."""
        return replace(self, joints={name: joint for name, joint in self.joints.items() if name not in joints})

    def swung(self, moved: Collection[str], motion: FloatArray, number: int) -> "Bundle":
        """The same with some parts moved by `motion` (4, 4) onto sheets of their own."""
        poses = {name: motion @ pose if name in moved else pose for name, pose in self.poses.items()}
        sheets = {name: (*sheet, number) if name in moved else sheet for name, sheet in self.sheets.items()}
        return replace(self, poses=poses, sheets=sheets)

    def held(self, poses: Mapping[str, FloatArray]) -> "Bundle":
        """The same at other poses."""
        return replace(self, poses=poses)

    @cached_property
    def folded(self) -> "Bundle":
        """The same folded flat, as it is in the finished pop-up; itself where it lies so."""
        flat = self.kit.reference.flat
        if not any(self.sheets.values()) and all(pose is flat[name] for name, pose in self.poses.items()):
            return self
        return replace(self, poses={name: flat[name] for name in self.poses}, sheets=dict.fromkeys(self.poses, ()))

"""Parts and joints that recur from plan to plan as the same objects.

A design is planned several times: with other seams, with folds opened. Most of its parts and joints are the same
each time, and what is known of them (how they touch, which nets they make) is remembered by what they are.
"""

from popsim.layout.joints import Joint
from popsim.layout.parts import Part


class Recurring:
    """The parts and joints of one design seen so far."""

    def __init__(self) -> None:
        self._parts: dict[tuple[str, bytes], Part] = {}
        self._joints: dict[tuple[str, tuple[str, str], bytes], Joint] = {}

    def parts(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """The same parts, each as it was first seen."""
        return tuple(self._parts.setdefault((part.id, part.polygon.wkb), part) for part in parts)

    def joints(self, joints: tuple[Joint, ...]) -> tuple[Joint, ...]:
        """The same joints, each as it was first seen."""
        return tuple(self._joints.setdefault(_content(joint), joint) for joint in joints)


def _content(joint: Joint) -> tuple[str, tuple[str, str], bytes]:
    return joint.id, joint.parts, b"".join(ends.tobytes() for ends in joint.stretches)

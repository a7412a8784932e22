"""Which hinges become joints of the tree and which close loops."""

from collections import deque
from dataclasses import dataclass
from functools import cached_property

from popsim.design import BACKDROP_ID, GROUND_ID, Design, Hinge

PAGES = (GROUND_ID, BACKDROP_ID)
"""The two driven patches, roots of the forest."""


@dataclass(frozen=True)
class TreeJoint:
    """A hinge of the forest: `child` hangs on `parent`."""

    hinge: Hinge
    parent: str
    child: str


@dataclass(frozen=True)
class Forest:
    """The hinges but those between roots, split in two.

    Attributes
    ----------
    joints:
        One per patch that is no root; parents come before their children.
    loops:
        The hinges that close loops, in the order of the design.
    """

    joints: tuple[TreeJoint, ...]
    loops: tuple[Hinge, ...]

    def hanging_on(self, patch: str) -> tuple[TreeJoint, ...]:
        """The joints of which a patch is the parent."""
        return self._children.get(patch, ())

    @cached_property
    def levels(self) -> tuple[list[int], ...]:
        """Positions of the joints by their number from the root: those of one level hang on earlier ones alone."""
        depth: dict[str, int] = {}
        found: list[list[int]] = []
        for index, joint in enumerate(self.joints):
            level = depth.get(joint.parent, 0)
            depth[joint.child] = level + 1
            if level == len(found):
                found.append([])
            found[level].append(index)
        return tuple(found)

    @cached_property
    def _children(self) -> dict[str, tuple[TreeJoint, ...]]:
        found: dict[str, tuple[TreeJoint, ...]] = {}
        for joint in self.joints:
            found[joint.parent] = (*found.get(joint.parent, ()), joint)
        return found


def spanning_forest(
    design: Design, guarded: frozenset[str] = frozenset(), roots: tuple[str, ...] = PAGES
) -> Forest:
    """Split the hinges of `design`; trees hang on the patches `roots`, which the pages are unless told otherwise.

    Flat creases come first, then the hinges named in `guarded`, because a joint can be limited to one side and a
    loop cannot; then hinges near the roots, which keeps the chains short.
    """
    depth = _depths(design, roots)
    hinges = [hinge for hinge in design.hinges if not set(hinge.patches) <= set(roots)]

    def rank(hinge: Hinge) -> tuple[bool, bool, int]:
        return hinge.crease is None, hinge.id not in guarded, min(depth[name] for name in hinge.patches)

    ranked = sorted(hinges, key=rank)
    chosen = _kruskal(design, ranked, roots)
    joints = _orient(design, chosen, roots)
    return Forest(joints, tuple(hinge for hinge in hinges if hinge.id not in chosen))


def _depths(design: Design, roots: tuple[str, ...]) -> dict[str, int]:
    """Hinges between each patch and the nearest root."""
    depth = dict.fromkeys(roots, 0)
    queue = deque(roots)
    while queue:
        name = queue.popleft()
        for hinge in design.hinges_by_patch[name]:
            other = hinge.other(name)
            if other not in depth:
                depth[other] = depth[name] + 1
                queue.append(other)
    return depth


def _kruskal(design: Design, ranked: list[Hinge], roots: tuple[str, ...]) -> set[str]:
    """Ids of the hinges that join separate trees, the roots being one tree from the start."""
    root = {patch.id: patch.id for patch in design.patches} | dict.fromkeys(roots, roots[0])

    def find(name: str) -> str:
        while root[name] != name:
            root[name] = root[root[name]]
            name = root[name]
        return name

    chosen = set()
    for hinge in ranked:
        first, second = (find(name) for name in hinge.patches)
        if first != second:
            root[second] = first
            chosen.add(hinge.id)
    return chosen


def _orient(design: Design, chosen: set[str], roots: tuple[str, ...]) -> tuple[TreeJoint, ...]:
    joints = []
    seen = set(roots)
    queue = deque(roots)
    while queue:
        name = queue.popleft()
        for hinge in design.hinges_by_patch[name]:
            child = hinge.other(name)
            if hinge.id in chosen and child not in seen:
                seen.add(child)
                joints.append(TreeJoint(hinge, name, child))
                queue.append(child)
    return tuple(joints)

"""First-order motions that the hinges leave, from the recorded poses."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray, IntArray, cross
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import transform
from popsim.simulation.forest import Forest


@dataclass(frozen=True, eq=False)
class Group:
    """Joints and loops that belong together: loops that share a joint are one group.

    Attributes
    ----------
    columns, loops:
        Positions of the joints in the forest and of the loops among its loops.
    entries:
        What is not zero in its matrix: the joints that move an end of a loop hinge.
    """

    columns: list[int]
    loops: list[int]
    entries: "Entries"


class Entries(NamedTuple):
    """One entry per loop, side of its hinge, and joint that carries that side and not the other.

    Position of the loop and of the joint in their group, of the patch in the design, 1 or -1 for the first or the
    second patch of the hinge, each of shape (k,); ends of the hinge in the open pose, shape (k, 2, 3).
    """

    row: IntArray
    column: IntArray
    patch: IntArray
    sign: FloatArray
    ends: FloatArray


class LoopJacobian:
    """How the gap at both ends of every loop hinge answers to the joints of the forest, with the pages held.

    Rows are mm of gap; columns are joints, scaled so that one unit moves the farthest point of the child by
    1 mm (`reach` holds its distance from the axis, mm). Its singular values are therefore mm of gap per mm of
    motion: pure numbers, the same for a card of any size and for a small mechanism on a large card.
    """

    def __init__(self, design: Design, forest: Forest) -> None:
        self._forest = forest
        self._place = {patch.id: index for index, patch in enumerate(design.patches)}
        self._children = np.array([self._place[joint.child] for joint in forest.joints], dtype=np.int64)
        self._axes = np.array([joint.hinge.points for joint in forest.joints]).reshape(-1, 2, 3)
        self.reach: FloatArray = np.array(
            [_reach(design, joint.child, joint.hinge.points) for joint in forest.joints]
        )
        self._lengths = np.array([joint.hinge.length for joint in forest.joints])
        self._joined = np.array([[self._place[name] for name in hinge.patches] for hinge in forest.loops]).reshape(
            -1, 2
        )
        self._ends = np.array([hinge.points for hinge in forest.loops]).reshape(-1, 2, 3)
        self._paths = self._loop_paths()
        self.groups = self._groups()

    def nullity(self, poses: FloatArray, threshold: float) -> tuple[IntArray, FloatArray]:
        """Number of free motions and the least singular value, at poses (n, p, 4, 4); shapes (n,), (n,).

        The least value of a design without loops and without joints is infinite.
        """
        free = np.zeros(len(poses), dtype=np.int64)
        least = np.full(len(poses), np.inf)
        for group in self.groups:
            values = self._singular_values(poses, group)
            free += (values < threshold).sum(axis=-1)
            least = np.minimum(least, values.min(axis=-1))
        return free, least

    def _singular_values(self, poses: FloatArray, group: Group) -> FloatArray:
        """All of one group, one per column (0 where there are fewer rows), shape (n, c)."""
        if not group.loops:
            return np.zeros((len(poses), len(group.columns)))
        values = np.linalg.svd(self.matrix(poses, group), compute_uv=False)
        return np.pad(values, ((0, 0), (0, max(len(group.columns) - values.shape[-1], 0))))

    def matrix(self, poses: FloatArray, group: Group) -> FloatArray:
        """Gap (first patch minus second) per unit of each joint of a group, shape (n, 6 loops, columns)."""
        count, columns, entries = len(poses), group.columns, group.entries
        ends = transform(poses[:, self._children[columns]], self._axes[columns])
        anchor = ends[:, :, 0]
        direction = (ends[:, :, 1] - anchor) / (self._lengths * self.reach)[columns][:, None]
        arms = transform(poses[:, entries.patch], entries.ends) - anchor[:, entries.column, None]
        swing = cross((entries.sign[:, None] * direction[:, entries.column])[:, :, None], arms)
        matrix = np.zeros((count, len(group.loops), len(columns), 6))
        matrix[:, entries.row, entries.column] = swing.reshape(count, len(entries.row), 6)
        return np.swapaxes(matrix, 2, 3).reshape(count, 6 * len(group.loops), len(columns))

    def residual(self, poses: FloatArray) -> FloatArray:
        """Gaps at both ends of each loop hinge, first patch minus second, mm, shape (n, loops, 6)."""
        first, second = (transform(poses[:, self._joined[:, side]], self._ends) for side in (0, 1))
        return np.asarray((first - second).reshape(len(poses), len(self._ends), 6))

    def _chain(self, name: str) -> list[int]:
        """Joints from a patch down to its page."""
        chain = []
        while name in self._above:
            index = self._above[name]
            chain.append(index)
            name = self._forest.joints[index].parent
        return chain

    def _loop_paths(self) -> list[set[int]]:
        """Joints that each loop runs through: those above one of its two patches, not above both."""
        self._above = {joint.child: index for index, joint in enumerate(self._forest.joints)}
        return [
            set(self._chain(hinge.patches[0])) ^ set(self._chain(hinge.patches[1])) for hinge in self._forest.loops
        ]

    def _groups(self) -> list[Group]:
        root = list(range(len(self._forest.joints)))

        def find(index: int) -> int:
            while root[index] != index:
                root[index] = root[root[index]]
                index = root[index]
            return index

        for path in self._paths:
            first, *rest = sorted(path)
            for other in rest:
                root[find(other)] = find(first)
        columns: dict[int, list[int]] = {}
        for index in range(len(root)):
            columns.setdefault(find(index), []).append(index)
        loops: dict[int, list[int]] = {key: [] for key in columns}
        for index, path in enumerate(self._paths):
            loops[find(min(path))].append(index)
        return [Group(columns[key], loops[key], self._entries(columns[key], loops[key])) for key in columns]

    def _entries(self, columns: list[int], loops: list[int]) -> Entries:
        local = {column: index for index, column in enumerate(columns)}
        rows = [
            (row, local[column], self._place[name], sign, self._forest.loops[loop].points)
            for row, loop in enumerate(loops)
            for sign, name in zip((1.0, -1.0), self._forest.loops[loop].patches, strict=True)
            for column in self._chain(name)
            if column in self._paths[loop]
        ]
        places = np.array([entry[:3] for entry in rows], dtype=np.int64).reshape(-1, 3)
        signs, ends = np.array([entry[3] for entry in rows]), np.array([entry[4] for entry in rows])
        return Entries(places[:, 0], places[:, 1], places[:, 2], signs, ends.reshape(-1, 2, 3))


def _reach(design: Design, child: str, axis: FloatArray) -> float:
    """Distance of the farthest point of a patch from an axis, mm."""
    return float(line_distance(design.patch_by_id[child].points, axis).max())

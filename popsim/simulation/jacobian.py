"""First-order motions that the hinges leave, from the recorded poses."""

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import transform
from popsim.simulation.forest import Forest


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
        self._paths = self._loop_paths()
        self.groups = self._group()

    def nullity(self, poses: FloatArray, threshold: float) -> tuple[IntArray, FloatArray]:
        """Number of free motions and the least singular value, at poses (n, p, 4, 4); shapes (n,), (n,).

        The least value of a design without loops and without joints is infinite.
        """
        free = np.zeros(len(poses), dtype=np.int64)
        least = np.full(len(poses), np.inf)
        for columns, loops in self.groups:
            values = self._singular_values(poses, columns, loops)
            free += (values < threshold).sum(axis=-1)
            least = np.minimum(least, values.min(axis=-1))
        return free, least

    def _singular_values(self, poses: FloatArray, columns: list[int], loops: list[int]) -> FloatArray:
        """All of one group, one per column (0 where there are fewer rows), shape (n, c)."""
        matrix = self.matrix(poses, columns, loops)
        values = np.linalg.svd(matrix, compute_uv=False) if loops else np.zeros((len(poses), 0))
        missing = len(columns) - values.shape[-1]
        return np.pad(values, ((0, 0), (0, max(missing, 0))))

    def matrix(self, poses: FloatArray, columns: list[int], loops: list[int]) -> FloatArray:
        """Gap (first patch minus second) per unit of each joint of a group, shape (n, 6 loops, columns)."""
        local = {column: index for index, column in enumerate(columns)}
        ends = transform(poses[:, self._children[columns]], self._axes[columns])
        anchor = ends[:, :, 0]
        direction = (ends[:, :, 1] - anchor) / (self._lengths * self.reach)[columns][:, None]
        matrix = np.zeros((len(poses), 6 * len(loops), len(columns)))
        for row, loop in enumerate(loops):
            hinge = self._forest.loops[loop]
            for sign, name in zip((1.0, -1.0), hinge.patches, strict=True):
                chain = [local[column] for column in self._chain(name) if column in self._paths[loop]]
                points = transform(poses[:, self._place[name]], hinge.points)
                arms = points[:, None] - anchor[:, chain, None]
                swing = _cross(direction[:, chain, None], arms).reshape(len(poses), len(chain), 6)
                matrix[:, 6 * row : 6 * row + 6, chain] = sign * np.swapaxes(swing, 1, 2)
        return matrix

    def residual(self, poses: FloatArray, loops: list[int]) -> FloatArray:
        """Gaps at both ends of each loop hinge, first patch minus second, mm, shape (n, 6 loops)."""
        rows = []
        for loop in loops:
            hinge = self._forest.loops[loop]
            first, second = (transform(poses[:, self._place[name]], hinge.points) for name in hinge.patches)
            rows.append((first - second).reshape(len(poses), 6))
        return np.concatenate(rows, axis=1)

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

    def _group(self) -> list[tuple[list[int], list[int]]]:
        """Joints and loops that belong together: loops that share a joint are one group."""
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
        return [(columns[key], loops[key]) for key in columns]


def _reach(design: Design, child: str, axis: FloatArray) -> float:
    """Distance of the farthest point of a patch from an axis, mm."""
    return float(line_distance(design.patch_by_id[child].points, axis).max())


def _cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross product over the last axis; numpy's own is slow on many small arrays."""
    x, y, z = np.moveaxis(first, -1, 0)
    a, b, c = np.moveaxis(second, -1, 0)
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)

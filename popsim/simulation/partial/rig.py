"""A partial structure in MuJoCo: a tree of hinges on a part that is held, equalities for loops and hands."""

from typing import Any

import numpy as np

from popsim.design import Hinge
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.plane import line_distance
from popsim.simulation.engine import load_mujoco
from popsim.simulation.forest import TreeJoint, spanning_forest
from popsim.simulation.mjcf import size_of
from popsim.simulation.partial.hands import led_joints
from popsim.simulation.partial.model import hand_on, partial_xml
from popsim.simulation.partial.polishing import polished
from popsim.simulation.partial.slopes import Slopes
from popsim.simulation.partial.structure import Structure
from popsim.simulation.rig import poses_of
from popsim.simulation.solver import TIMESTEP
from popsim.simulation.turning import turnings

PRESSED = 10.0
"""What a height over the plane counts beside a gap in the end: what is not made to lie flat opens, not stands."""


class PartialRig:
    """The MuJoCo model of a structure. Lengths mm, angles rad.

    Attributes
    ----------
    structure:
        What was built.
    forest:
        Its hinges: those in the tree on the root, and those that close loops.
    turning:
        The joints of the tree that turn; angles are in their order.
    """

    def __init__(self, structure: Structure) -> None:
        mujoco = load_mujoco()
        design = structure.design
        self.structure = structure
        self.forest = spanning_forest(design, structure.seams, (structure.root,))
        self.turning = [joint for joint in self.forest.joints if joint.hinge.id not in structure.seams]
        self._scale = size_of(design)
        self._model: Any = mujoco.MjModel.from_xml_string(
            partial_xml(structure, self.forest, self.turning, self._scale)
        )
        self._data: Any = mujoco.MjData(self._model)
        self._step, self._place, self._turn = mujoco.mj_step, mujoco.mj_kinematics, mujoco.mju_mat2Quat
        self._bodies = np.array([self._model.body(patch.id).id for patch in design.patches])
        self._order = np.array([self._model.joint(j.hinge.id).qposadr[0] for j in self.turning], dtype=np.int64)
        self._hands = np.array([self._model.equality(hand_on(j)).id for j in self.turning], dtype=np.int64)
        self._columns = np.array([self._model.joint(j.hinge.id).dofadr[0] for j in self.turning], dtype=np.int64)
        self._reaches = np.array([self._reach(joint) for joint in self.turning]) / self._scale
        corners = [(hinge, corner) for hinge in self.forest.loops for corner in self._meeting(hinge)]
        self._joined = np.array(
            [[self._model.body(name).id for name in hinge.patches] for hinge, _ in corners], dtype=np.int64
        ).reshape(-1, 2)
        self._ends = np.array([corner for _, corner in corners]).reshape(-1, 3) / self._scale
        self._slopes_of = Slopes(self._model)
        self._cornered = np.repeat(self._bodies, 3)
        self._corners_of = np.concatenate([_spread(patch.points) for patch in design.patches]) / self._scale
        self._senses = np.array([self._sense(joint) for joint in self.turning])

    def angles(self, poses: FloatArray) -> FloatArray:
        """Angle of each turning joint in poses (n, p, 4, 4) of the parts from the open one on, shape (n, j)."""
        if not self.turning:
            return np.zeros((len(poses), 0))
        place = {patch.id: k for k, patch in enumerate(self.structure.design.patches)}
        hinges = [joint.hinge for joint in self.turning]
        first, second = (poses[:, [place[hinge.patches[side]] for hinge in hinges]] for side in (0, 1))
        return self._senses * turnings(hinges, first, second)

    def start(self, angles: FloatArray) -> None:
        """Take all joints to angles (j,), at rest."""
        self._data.qpos[self._order] = angles
        self._data.qvel[:] = 0
        self._place(self._model, self._data)

    def hold(self, led: IntArray) -> None:
        """Let hands lead joints (f,), and no others."""
        self._data.eq_active[self._hands] = 0
        self._data.eq_active[self._hands[led]] = 1

    def put(self, pose: FloatArray) -> None:
        """Put the root to a pose (4, 4), and all else with it."""
        self._turn(self._data.mocap_quat[0], pose[:3, :3].ravel())
        self._data.mocap_pos[0] = pose[:3, 3] / self._scale

    def lead(self, angles: FloatArray) -> None:
        """Where hands lead the joints that are held: to their share of `angles` (j,)."""
        self._model.eq_data[self._hands, 0] = angles

    def rest(self, most: int, settled: float) -> None:
        """Steps from rest until no joint turns by more than `settled`, rad, in one; at `most` so many."""
        for _ in range(most):
            self._settle()
            if np.abs(self._data.qvel).max(initial=0.0) * TIMESTEP < settled:
                break

    def polish(self, angles: FloatArray) -> None:
        """Take off what the steps have left of loop gaps and of what hands lead to `angles` (j,)."""
        polished(self.now, lambda now: self._error(now, angles), self._slopes)

    def flatten(self) -> None:
        """Let all hands go and press all parts into the plane y = 0, with as small gaps as there can be.

        Flat poses are where ways part: what is led is led along all of them, and a loop may be closed with its
        other parts anywhere about one line. A hand on the pile decides.
        """
        self.hold(np.arange(0))
        polished(
            self.now,
            lambda now: np.concatenate([self._error(now, now), PRESSED * self._corner_places[:, 1]]),
            lambda: np.concatenate([self._slopes(), PRESSED * self._corner_slopes()]),
        )

    @property
    def now(self) -> FloatArray:
        """Of all joints that turn, rad, shape (j,)."""
        return np.array(self._data.qpos[self._order])

    def _error(self, now: FloatArray, angles: FloatArray) -> FloatArray:
        """Gaps and what hands are off `angles` (j,) with joints at `now`, in units of the model, (3 e + f,)."""
        self.start(now)
        ends = self._loop_ends()
        return np.concatenate([np.ravel(ends[:, 0] - ends[:, 1]), ((now - angles) * self._reaches)[self._held]])

    def _slopes(self) -> FloatArray:
        """How :meth:`_error` answers to the joints, per rad, shape (3 e + f, j)."""
        return np.concatenate([self._loop_matrix(), np.diag(self._reaches)[self._held]])

    @property
    def _held(self) -> BoolArray:
        """Which joints hands lead, shape (j,)."""
        return np.asarray(self._data.eq_active[self._hands] > 0)

    @property
    def _corner_places(self) -> FloatArray:
        """Three corners of each part now, units of the model, shape (3 p, 3)."""
        turns = self._data.xmat[self._cornered].reshape(-1, 3, 3)
        return np.asarray((turns @ self._corners_of[:, :, None])[..., 0] + self._data.xpos[self._cornered])

    def _corner_slopes(self) -> FloatArray:
        """How their heights answer to the joints, per rad, shape (3 p, j)."""
        return self._slopes_of.of(self._data, self._cornered, self._corner_places)[:, 1, self._columns]

    def _settle(self) -> None:
        self._data.qvel[:] = 0
        self._step(self._model, self._data)

    def led(self) -> IntArray:
        """The joints that hands have to lead from where everything is now, shape (f,)."""
        fold = next((k for k, joint in enumerate(self.turning) if joint.hinge.kind == "central"), None)
        return led_joints(self._loop_matrix() / self._reaches, fold)

    def poses(self) -> FloatArray:
        """Motion of each part from the open pose, in the order of the design, mm, shape (p, 4, 4)."""
        self._place(self._model, self._data)
        return poses_of(self._data, self._bodies, self._scale)

    def _loop_ends(self) -> FloatArray:
        """Where either side of each loop has its ends now, units of the model, shape (e, 2, 3)."""
        turns = self._data.xmat[self._joined].reshape(-1, 2, 3, 3)
        return np.asarray((turns @ self._ends[:, None, :, None])[..., 0] + self._data.xpos[self._joined])

    def _loop_matrix(self) -> FloatArray:
        """How gaps at the ends of loops answer to the joints, per rad, shape (3 e, j)."""
        one, other = (
            self._slopes_of.of(self._data, self._joined[:, side], self._loop_ends()[:, side]) for side in (0, 1)
        )
        return np.asarray((one - other).reshape(3 * len(self._joined), self._model.nv)[:, self._columns])

    def _meeting(self, hinge: Hinge) -> FloatArray:
        """Places of the open pose at which the two sides of a loop meet, shape (2, 3), or (3, 3) of a seam."""
        if hinge.id not in self.structure.seams:
            return hinge.points
        points = self.structure.design.patch_by_id[hinge.patches[0]].points
        return np.concatenate([hinge.points, points[[line_distance(points, hinge.points).argmax()]]])

    def _sense(self, joint: TreeJoint) -> float:
        """1 where a joint turns as the second patch of its hinge against the first, about its axis; else -1."""
        hinge = joint.hinge
        along = (hinge.points[1] - hinge.points[0]) @ self._model.joint(hinge.id).axis
        return float(np.sign(along)) * (1.0 if hinge.patches[1] == joint.child else -1.0)

    def _reach(self, joint: TreeJoint) -> float:
        points = self.structure.design.patch_by_id[joint.child].points
        return float(line_distance(points, joint.hinge.points).max())


def _spread(points: FloatArray) -> FloatArray:
    """Three of some corners (n, 3), far from each other: where these are flat, all are, shape (3, 3)."""
    first = points[np.linalg.norm(points - points[0], axis=1).argmax()]
    second = points[np.linalg.norm(points - first, axis=1).argmax()]
    return np.stack([first, second, points[line_distance(points, np.stack([first, second])).argmax()]])

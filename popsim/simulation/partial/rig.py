"""A partial structure in MuJoCo: a tree of hinges on a part that is held, equalities for loops and hands."""

from html import escape
from typing import Any

import numpy as np

from popsim.design import Hinge
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.plane import line_distance
from popsim.simulation.engine import load_mujoco
from popsim.simulation.forest import TreeJoint, spanning_forest
from popsim.simulation.mjcf import Recipe, body_tree, loops, mass_and_joint, options, size_of
from popsim.simulation.partial.hands import led_joints, loop_matrix
from popsim.simulation.partial.structure import Structure
from popsim.simulation.pressing import pressing_wrenches
from popsim.simulation.rig import poses_of
from popsim.simulation.solver import BRISK, TIMESTEP
from popsim.simulation.turning import turnings

POLISHES = 40
"""Steps of Newton's method at most."""

BOLDER, MORE_CAREFUL = 0.1, 20.0
"""Factors on the damping after a step that made gaps smaller, and after one that did not and is undone."""

FLOOR = 1e-13
"""Least damping: above rounding."""

DONE = 1e-9
"""Gap over the size of the structure that needs no more."""

FIXED = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
"""A part that is one with its parent: how heavy it is does not matter."""


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
        self._model: Any = mujoco.MjModel.from_xml_string(self._xml())
        self._data: Any = mujoco.MjData(self._model)
        self._step, self._place, self._turn = mujoco.mj_step, mujoco.mj_kinematics, mujoco.mju_mat2Quat
        self._normals = np.array([patch.plane.normal for patch in design.patches])
        self._bodies = np.array([self._model.body(patch.id).id for patch in design.patches])
        self._order = np.array([self._model.joint(j.hinge.id).qposadr[0] for j in self.turning], dtype=np.int64)
        self._hands = np.array([self._model.equality(_hand(j)).id for j in self.turning], dtype=np.int64)
        self._columns = np.array([self._model.joint(j.hinge.id).dofadr[0] for j in self.turning], dtype=np.int64)
        self._reaches = np.array([self._reach(joint) for joint in self.turning]) / self._scale
        corners = [(hinge, corner) for hinge in self.forest.loops for corner in self._corners(hinge)]
        self._joined = np.array(
            [[self._model.body(name).id for name in hinge.patches] for hinge, _ in corners], dtype=np.int64
        ).reshape(-1, 2)
        self._ends = np.array([corner for _, corner in corners]).reshape(-1, 3) / self._scale
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
        """Take off what the steps have left of loop gaps and of what hands lead to `angles` (j,).

        Newton's method with damping, on the gaps and their Jacobian as MuJoCo has them: near flat poses steps of
        the integration close ever less of them. What does not become smaller is undone.
        """
        damping, best = 1.0, self._error(angles)
        for _ in range(POLISHES):
            if np.abs(best).max(initial=0.0) < DONE:
                break
            before, matrix = np.array(self._data.qpos), self._slopes()
            normal = matrix.T @ matrix + (damping * np.linalg.norm(best) + FLOOR) * np.eye(matrix.shape[1])
            self._data.qpos[self._order] -= np.linalg.solve(normal, matrix.T @ best)
            self._place(self._model, self._data)
            now = self._error(angles)
            if np.abs(now).max() < np.abs(best).max():
                damping, best = damping * BOLDER, now
            else:
                self._data.qpos[:] = before
                self._place(self._model, self._data)
                damping *= MORE_CAREFUL

    def _error(self, angles: FloatArray) -> FloatArray:
        """Gaps and what hands are off their angles (j,), in units of the model, shape (3 e + f,)."""
        held = self._data.eq_active[self._hands] > 0
        off = (self._data.qpos[self._order] - angles) * self._reaches
        gaps = [one - other for one, other in self._loop_ends()]
        return np.concatenate([np.ravel(gaps), off[held]])

    def _slopes(self) -> FloatArray:
        """How :meth:`_error` answers to the joints, per rad, shape (3 e + f, j)."""
        held = self._data.eq_active[self._hands] > 0
        return np.concatenate([self._loop_matrix(), np.diag(self._reaches)[held]])

    def press(self, count: int) -> None:
        """Steps from rest in which all parts are pushed into the plane y = 0 where they are."""
        for _ in range(count):
            wrenches = pressing_wrenches(self._model, self._data, self._bodies, self._normals)
            self._data.xfrc_applied[self._bodies] = wrenches
            self._settle()
        self._data.xfrc_applied[:] = 0

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

    def _xml(self) -> str:
        structure, recipe = self.structure, Recipe(self._scale, BRISK.damping, BRISK.impedance)

        def content(joint: TreeJoint) -> str:
            if joint.hinge.id in structure.seams:
                return FIXED
            return mass_and_joint(structure.design, joint, structure.turns, recipe)

        bodies = body_tree(
            f'<body name="{escape(structure.root)}" mocap="true">', structure.root, self.forest, content
        )
        hands = "".join(
            f'<joint name="{_hand(joint)}" joint1="{escape(joint.hinge.id)}" active="false"/>'
            for joint in self.turning
        )
        stiff = "".join(
            f'<weld body1="{escape(hinge.patches[0])}" body2="{escape(hinge.patches[1])}"/>'
            for hinge in self.forest.loops
            if hinge.id in structure.seams
        )
        return (
            '<mujoco model="partial"><compiler angle="radian"/>'
            f"{options(recipe, 'autoreset contact')}<worldbody>{bodies}</worldbody>"
            f"<equality>{loops(self.forest, recipe)}{stiff}{hands}</equality></mujoco>"
        )

    def _loop_ends(self) -> FloatArray:
        """Where either side of each loop has its ends now, units of the model, shape (e, 2, 3)."""
        turns = self._data.xmat[self._joined].reshape(-1, 2, 3, 3)
        return np.asarray((turns @ self._ends[:, None, :, None])[..., 0] + self._data.xpos[self._joined])

    def _loop_matrix(self) -> FloatArray:
        """How gaps at the ends of loops answer to the joints, per rad, shape (3 e, j)."""
        return loop_matrix(self._model, self._data, self._joined, self._loop_ends())[:, self._columns]

    def _corners(self, hinge: Hinge) -> FloatArray:
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


def _hand(joint: TreeJoint) -> str:
    return escape(f"hand on {joint.hinge.id}")

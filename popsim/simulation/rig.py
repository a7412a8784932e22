"""A design hung on its two pages in MuJoCo."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.frame import OPEN
from popsim.simulation.engine import load_mujoco
from popsim.simulation.forest import PAGES, Forest, spanning_forest
from popsim.simulation.jacobian import LoopJacobian
from popsim.simulation.mjcf import Recipe, size_of, write_mjcf
from popsim.simulation.pressing import pressing_wrenches
from popsim.simulation.solver import Pacing
from popsim.simulation.turning import Turn, turns_of


class Rig:
    """The MuJoCo model of a design and its state. Angles are fold angles in rad, lengths mm.

    Attributes
    ----------
    design, forest:
        What was built, and which hinges are joints.
    turns:
        How far each hinge but the central one turns before paper is in the way, by its id; worked out where they
        are not given.
    scale:
        mm per unit of length of the model.
    model, data:
        MuJoCo's own.
    joint_order, joint_axes, joint_limits:
        Where MuJoCo keeps the angle of each joint of the forest, its axis in the open pose, shape (j, 3), and
        its least and greatest angle, rad, each of shape (j,).
    """

    def __init__(
        self,
        design: Design,
        pacing: Pacing,
        guarded: frozenset[str] = frozenset(),
        turns: Mapping[str, Turn] | None = None,
    ) -> None:
        mujoco = load_mujoco()
        self.design = design
        self.forest: Forest = spanning_forest(design, guarded)
        self.turns = turns_of(design) if turns is None else turns
        self.scale = size_of(design)
        xml = write_mjcf(design, self.forest, self.turns, Recipe(self.scale, pacing.damping, pacing.impedance))
        self.model: Any = mujoco.MjModel.from_xml_string(xml)
        self.data: Any = mujoco.MjData(self.model)
        self._pages, self._velocities = self.data.mocap_quat, self.data.qvel
        self._step = mujoco.mj_step
        self._place = mujoco.mj_kinematics
        joints = [self.model.joint(joint.hinge.id).id for joint in self.forest.joints]
        self.joint_order = self.model.jnt_qposadr[joints]
        self.joint_axes: FloatArray = self.model.jnt_axis[joints]
        limited = self.model.jnt_limited[:, None].astype(bool)
        ranges = np.where(limited, self.model.jnt_range, [[-np.inf, np.inf]])
        self.joint_limits: tuple[FloatArray, FloatArray] = tuple(ranges[self.joint_order].T)
        self._normals = np.array([patch.plane.normal for patch in design.patches])
        self._bodies = np.array([self.model.body(patch.id).id for patch in design.patches])

    @cached_property
    def jacobian(self) -> LoopJacobian:
        """How the loops answer to the joints."""
        return LoopJacobian(self.design, self.forest)

    def hold(self, quaternions: FloatArray) -> None:
        """Set ground and backdrop to two quaternions of :func:`page_quaternions`, shape (2, 4)."""
        self._pages[:] = quaternions

    def step(self, count: int = 1) -> None:
        """Integrate."""
        self._step(self.model, self.data, count)

    def settle(self, count: int) -> None:
        """Steps from rest: each is a Gauss-Newton step on the loop equations."""
        for _ in range(count):
            self._velocities[:] = 0
            self._step(self.model, self.data)

    def strain(self) -> float:
        """Largest part of a loop gap before the last step, over the size of the pop-up, as MuJoCo has it."""
        return float(np.abs(self.data.efc_pos[: self.data.ne]).max(initial=0.0))

    def restore(self, state: FloatArray, quaternions: FloatArray) -> None:
        """Go to recorded joint positions with the pages held as :meth:`hold` says, at rest."""
        self.data.qpos[:] = state
        self.data.qvel[:] = 0
        self.data.qacc_warmstart[:] = 0
        self.hold(quaternions)

    @contextmanager
    def without_preloads(self) -> Iterator[None]:
        """Take the preloads off the flat creases for a while: what holds a patch must be the structure."""
        stiffness = self.model.jnt_stiffness.copy()
        self.model.jnt_stiffness[:] = 0
        try:
            yield
        finally:
            self.model.jnt_stiffness[:] = stiffness

    def push(self, wrenches: FloatArray | None) -> None:
        """Apply forces and torques to the bodies until told otherwise, units of the model, shape (bodies, 6)."""
        self.data.xfrc_applied[:] = 0 if wrenches is None else wrenches

    def load(self, wrenches: FloatArray) -> None:
        """Apply forces and moments to the patches where they are, until :meth:`push` is told otherwise.

        In the order of the design, moments about the origin of the card frame, in any unit of force and that unit
        times mm, shape (p, 6).
        """
        self._place(self.model, self.data)
        force, moment = wrenches[:, :3], wrenches[:, 3:] / self.scale
        pushes = np.zeros((self.model.nbody, 6))
        pushes[self._bodies, :3] = force
        pushes[self._bodies, 3:] = moment - np.cross(self.data.xipos[self._bodies], force)
        self.push(pushes)

    def press(self, count: int) -> None:
        """Steps from rest in which all plates are pushed into the plane y = 0, as the closed pages do it.

        With both pages on each other some parts hang on one line alone, the back walls of a v-fold for one, and
        nothing but the pages lays them flat.
        """
        for _ in range(count):
            pushes = pressing_wrenches(self.model, self.data, self._bodies, self._normals)
            self.data.xfrc_applied[self._bodies] = pushes
            self.settle(1)
        self.push(None)

    def poses(self) -> FloatArray:
        """Motion of each patch from the open pose, in the order of the design, mm, shape (p, 4, 4)."""
        self._place(self.model, self.data)
        return poses_of(self.data, self._bodies, self.scale)

    def state(self) -> FloatArray:
        """Joint positions as MuJoCo orders them, shape (q,)."""
        return np.array(self.data.qpos)


def poses_of(data: Any, bodies: IntArray, scale: float) -> FloatArray:
    """Motion of bodies that MuJoCo has placed from the open pose, mm, shape (k, 4, 4); `scale` mm are a unit."""
    poses = np.zeros((len(bodies), 4, 4))
    poses[:, :3, :3] = data.xmat[bodies].reshape(-1, 3, 3)
    poses[:, :3, 3] = data.xpos[bodies] * scale
    poses[:, 3, 3] = 1
    return poses


def page_quaternions(theta: FloatArray) -> FloatArray:
    """Orientation of ground and backdrop at fold angles (n,), as MuJoCo quaternions, shape (n, 2, 4)."""
    half = (OPEN - np.asarray(theta, float)) / 4
    turns = np.zeros((*half.shape, len(PAGES), 4))
    turns[..., 0] = np.cos(half)[..., None]
    turns[..., 0, 1] = np.sin(half)
    turns[..., 1, 1] = -np.sin(half)
    return turns

"""Plates of some thickness in MuJoCo, put into recorded poses to measure how far apart they are."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.simulation.engine import load_mujoco
from popsim.simulation.plates import mesh_assets, mesh_geoms


class Scene:
    """Some patches as convex prisms on mocap bodies.

    Parameters
    ----------
    prisms:
        Convex pieces of each patch, open pose, in units of `scale` mm, each of shape (k, 3), by the position of
        the patch among the poses given to :meth:`place`.
    scale:
        mm per unit of the scene.
    """

    def __init__(self, prisms: Mapping[int, Sequence[FloatArray]], scale: float) -> None:
        self._mujoco = mujoco = load_mujoco()
        self._members = list(prisms)
        self._scale = scale
        counts = np.cumsum([0, *(len(pieces) for pieces in prisms.values())])
        self._geoms = {member: range(counts[i], counts[i + 1]) for i, member in enumerate(prisms)}
        self._model: Any = mujoco.MjModel.from_xml_string(_mjcf(prisms))
        self._data: Any = mujoco.MjData(self._model)
        self._segment = np.zeros(6)

    def place(self, poses: FloatArray) -> None:
        """Put the patches where `poses` (p, 4, 4) say."""
        for body, member in enumerate(self._members):
            self._mujoco.mju_mat2Quat(self._data.mocap_quat[body], poses[member, :3, :3].ravel())
            self._data.mocap_pos[body] = poses[member, :3, 3] / self._scale
        self._mujoco.mj_kinematics(self._model, self._data)

    def distance(self, first: int, second: int, most: float) -> float:
        """Distance of two patches, mm, or `most` where it is greater.

        Negative where they overlap: the least shift that would part their deepest pieces.
        """
        nearest = min(
            self._mujoco.mj_geomDistance(self._model, self._data, one, other, most / self._scale, self._segment)
            for one in self._geoms[first]
            for other in self._geoms[second]
        )
        return float(nearest * self._scale)


def _mjcf(prisms: Mapping[int, Sequence[FloatArray]]) -> str:
    meshes, bodies, count = [], [], 0
    for member, pieces in prisms.items():
        meshes.append(mesh_assets(count, list(pieces)))
        bodies.append(f'<body name="{member}" mocap="true">{mesh_geoms(count, list(pieces))}</body>')
        count += len(pieces)
    return (
        f'<mujoco model="plates"><asset>{"".join(meshes)}</asset><worldbody>{"".join(bodies)}</worldbody></mujoco>'
    )

"""How things are put on the table."""

from collections.abc import Mapping

import numpy as np

from popsim.design import GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.geometry.rigid import transform
from popsim.layout import Layout

PARALLEL = 0.999
"""Cosine below which two normals differ."""


def on_table(layout: Layout, poses: Mapping[str, FloatArray], spot: FloatArray, up: FloatArray) -> FloatArray:
    """Motion (4, 4) that puts parts at `poses` on the table, the worked face upward.

    The card keeps the ground where it is in the open pose, or is turned over about its fold; all else is turned
    so that `up` (3,) becomes z and `spot` (3,) the origin.
    """
    ground = next((name for name, part in layout.parts.items() if part.patch.id == GROUND_ID), None)
    if ground is not None and ground in poses:
        back = np.asarray(np.linalg.inv(poses[ground]))
        rise = float((back[:3, :3] @ up)[2])
        return turned_over() @ back if rise < -PARALLEL else back
    plane = Plane.facing(up, spot)
    motion = np.eye(4)
    motion[:3, :3] = np.stack([plane.u, plane.v, plane.normal])
    motion[:3, 3] = -motion[:3, :3] @ spot
    return motion


def turned_over() -> FloatArray:
    """Half a turn about the x axis, shape (4, 4)."""
    return np.diag([1.0, -1.0, -1.0, 1.0])


def heights(points: FloatArray, pose: FloatArray, spot: FloatArray, up: FloatArray) -> FloatArray:
    """Heights of the points (m, 3) of a part at `pose` over the plane through `spot` with normal `up`, mm."""
    return np.asarray((transform(pose, points) - spot) @ up)

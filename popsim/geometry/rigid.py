"""Rigid motions as homogeneous matrices, one per fold angle."""

from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray, cross


class Frame(NamedTuple):
    """An orthonormal frame on a moving patch: origin and two in-plane axes, each of shape (n, 3)."""

    origin: FloatArray
    first: FloatArray
    second: FloatArray


def motion_between(start: Frame, frames: Frame) -> FloatArray:
    """Motion that carries `start` (one row) to each row of `frames`, shape (n, 4, 4)."""
    turn = _axes(frames) @ np.swapaxes(_axes(start), -1, -2)
    poses = np.zeros((len(turn), 4, 4))
    poses[:, :3, :3] = turn
    poses[:, :3, 3] = frames.origin - (turn @ start.origin[0])
    poses[:, 3, 3] = 1
    return poses


def transform(poses: FloatArray, points: FloatArray) -> FloatArray:
    """Move points (k, 3) by poses (..., 4, 4); returns (..., k, 3)."""
    turned = points @ np.swapaxes(poses[..., :3, :3], -1, -2)
    return np.asarray(turned + poses[..., None, :3, 3])


def translation(offset: FloatArray) -> FloatArray:
    """Homogeneous matrix (4, 4) that shifts by `offset` (3,)."""
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def turns_about(axis: FloatArray, point: FloatArray, angles: FloatArray) -> FloatArray:
    """Rotations about axes through points (Rodrigues).

    Parameters
    ----------
    axis, point:
        Unit direction and a point of each axis, shape (..., 3).
    angles:
        rad, of a shape (...) that fits to theirs: (n,) about one axis (3,), or (n, j) about axes (j, 3).

    Returns
    -------
    Homogeneous matrices, shape (..., 4, 4).
    """
    x, y, z = np.moveaxis(np.asarray(axis, float), -1, 0)
    zero = np.zeros_like(x)
    skew = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
    sine, versine = np.sin(angles)[..., None, None], 2 * np.sin(angles / 2)[..., None, None] ** 2
    turns = np.zeros((*np.shape(sine)[:-2], 4, 4))
    turns[..., :3, :3] = np.eye(3) + sine * skew + versine * (skew @ skew)
    turns[..., :3, 3] = point - (turns[..., :3, :3] @ np.asarray(point)[..., None])[..., 0]
    turns[..., 3, 3] = 1
    return turns


def _axes(frame: Frame) -> FloatArray:
    """Rotation matrices whose columns are the two axes and their cross product, shape (n, 3, 3)."""
    columns = [frame.first, frame.second, cross(frame.first, frame.second)]
    return np.stack(np.broadcast_arrays(*columns), axis=-1)

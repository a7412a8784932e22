"""Unit directions: across another one, and spread evenly over the sphere or about an axis."""

import numpy as np

from popsim.geometry.arrays import FloatArray, cross

GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
"""Radians; turned by this from one to the next, no two directions of a spiral ever line up."""


def across(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit directions at right angles to each unit `axis` (..., 3) and to each other, both (..., 3)."""
    first = cross(axis, np.eye(3)[np.abs(axis).argmin(axis=-1)])
    first /= np.linalg.norm(first, axis=-1, keepdims=True)
    return first, cross(axis, first)


def sphere_directions(count: int) -> FloatArray:
    """Return `count` unit directions spread evenly over the sphere (a Fibonacci spiral), shape (count, 3)."""
    z = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = GOLDEN * np.arange(count)
    ring = np.sqrt(1.0 - z * z)
    return np.column_stack([ring * np.cos(angle), ring * np.sin(angle), z])


def cone_directions(axis: FloatArray, radius: float, count: int) -> FloatArray:
    """Return `count` unit directions evenly within `radius` (rad, small) of the unit `axis`, shape (count, 3)."""
    first, second = across(axis)
    reach = radius * np.sqrt((np.arange(count) + 0.5) / count)
    angle = GOLDEN * np.arange(count)
    offset = np.outer(reach * np.cos(angle), first) + np.outer(reach * np.sin(angle), second)
    result: FloatArray = axis + offset
    result /= np.linalg.norm(result, axis=1, keepdims=True)
    return result

"""Rigid motions in a plane: what unfolding and nesting move pieces of paper with.

A flat motion is a homogeneous matrix (3, 3): a turn and a shift, never a mirror, so that the printed side stays
up.
"""

from typing import TYPE_CHECKING, TypeVar

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    Shape = TypeVar("Shape", bound=BaseGeometry)

GRID = 1e-6
"""mm; overlays are computed on this grid: far below paper, far above rounding."""


def flat_motion(angle: float, shift: npt.ArrayLike = (0.0, 0.0)) -> FloatArray:
    """Turn by `angle` (radians, counterclockwise) about the origin, then shift by `shift` (2,); shape (3, 3)."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = np.asarray(shift, float)
    return np.array([[cos, -sin, x], [sin, cos, y], [0.0, 0.0, 1.0]])


def segment_motion(source: FloatArray, target: FloatArray) -> FloatArray:
    """Motion (3, 3) that carries segment `source` (2, 2) onto `target` (2, 2), midpoint on midpoint."""
    along, onto = source[1] - source[0], target[1] - target[0]
    angle = np.arctan2(onto[1], onto[0]) - np.arctan2(along[1], along[0])
    turn = flat_motion(float(angle))
    return flat_motion(float(angle), target.mean(axis=0) - turn[:2, :2] @ source.mean(axis=0))


def move(motion: FloatArray, points: FloatArray) -> FloatArray:
    """Move points (..., 2) by a flat motion or any affine matrix (3, 3)."""
    return np.asarray(points @ motion[:2, :2].T + motion[:2, 2])


def move_shape(motion: FloatArray, shape: "Shape") -> "Shape":
    """Move a shapely geometry by a flat motion (3, 3)."""
    import shapely

    moved: Shape = shapely.transform(shape, lambda points: move(motion, points))
    return moved


def inverse(motion: FloatArray) -> FloatArray:
    """Inverse of a flat motion or any affine matrix (3, 3)."""
    return np.asarray(np.linalg.inv(motion), dtype=np.float64)


def common(one: "BaseGeometry", other: "BaseGeometry") -> "BaseGeometry":
    """What two geometries share, on a grid of GRID.

    Without a grid, edges that coincide but for rounding can make an overlay lose areas.
    """
    import shapely

    return shapely.intersection(_pure(one), _pure(other), grid_size=GRID)


def without(one: "BaseGeometry", other: "BaseGeometry") -> "BaseGeometry":
    """What of `one` lies outside `other`, on a grid of GRID."""
    import shapely

    return shapely.difference(_pure(one), _pure(other), grid_size=GRID)


def _pure(shape: "BaseGeometry") -> "BaseGeometry":
    """`shape` without the points and lines that an overlay leaves beside areas: no overlay takes both."""
    import shapely

    if shape.geom_type != "GeometryCollection":
        return shape
    return shapely.union_all([part for part in shapely.get_parts(shape) if shapely.get_dimensions(part) == 2])


def left_of(line: FloatArray) -> FloatArray:
    """Unit normal (2,) to the left of a directed segment (2, 2)."""
    along = line[1] - line[0]
    return np.asarray(np.array([-along[1], along[0]]) / np.linalg.norm(along))

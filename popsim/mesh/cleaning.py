"""Leaves out triangles that bound nothing."""

from pathlib import Path

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import BoolArray, FloatArray

FLATNESS = 1e-10
"""A triangle whose doubled area is below this part of its longest edge squared is a line in float64."""
LINE = 1e-9
"""A model whose second extent is below this part of its first one is a line."""


def usable_triangles(corners: FloatArray, path: Path) -> tuple[BoolArray, list[str]]:
    """Tell which triangles have finite corners and an area.

    Parameters
    ----------
    corners:
        Shape (m, 3, 3).
    path:
        The model, for the error.

    Returns
    -------
    keep:
        Shape (m,).
    notes:
        What is left out, one sentence each.

    Raises
    ------
    MeshError
        Nothing is left, or all that is left lies on one line or in one point.
    """
    if not len(corners):
        raise MeshError(f"{path.name}: no faces found; a pop-up needs a surface, not points or lines")
    finite = np.asarray(np.isfinite(corners).all(axis=(1, 2)))
    if not finite.any():
        raise MeshError(f"{path.name}: all {len(corners)} faces have coordinates that are not numbers")
    low, high = corners[finite].min(axis=(0, 1)), corners[finite].max(axis=(0, 1))
    with np.errstate(over="ignore"):
        size = float((high - low).max())
    if not np.isfinite(size):
        raise MeshError(f"{path.name}: coordinates reach {np.abs([low, high]).max():.3g}, too far for arithmetic")
    if size == 0.0:
        raise MeshError(f"{path.name}: all points of its faces coincide; a pop-up needs a surface")
    unit = (corners if finite.all() else corners[finite]) - low
    unit /= size
    keep = finite.copy()
    doubled, has_area = _areas(unit)
    keep[finite] = has_area
    if not keep.any() or (doubled.max() <= LINE and _on_a_line(unit[has_area])):
        raise MeshError(f"{path.name}: all points of its faces lie on one line; a pop-up needs a surface")
    return keep, _notes(int((~finite).sum()), int((finite & ~keep).sum()))


def _areas(unit_corners: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return the doubled area of each triangle (m,), and whether it is one, and not a line."""
    first = unit_corners[:, 1] - unit_corners[:, 0]
    second = unit_corners[:, 2] - unit_corners[:, 0]
    doubled = np.linalg.norm(np.cross(first, second), axis=1)
    longest = np.maximum(np.square(first).sum(axis=1), np.square(second).sum(axis=1))
    second -= first
    longest = np.maximum(longest, np.square(second).sum(axis=1))
    return doubled, doubled > FLATNESS * longest


def _on_a_line(unit_corners: FloatArray) -> bool:
    points = unit_corners.reshape(-1, 3)
    spread = np.linalg.svd(np.cov((points - points.mean(axis=0)).T), compute_uv=False)
    return bool(spread[1] <= LINE**2 * spread[0])


def _notes(undefined: int, degenerate: int) -> list[str]:
    notes = []
    if undefined:
        notes.append(f"faces left out because their coordinates are not numbers: {undefined}")
    if degenerate:
        notes.append(f"faces left out because they have no area: {degenerate}")
    return notes

"""Leaves out triangles that bound nothing."""

from pathlib import Path

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import BoolArray, FloatArray, cross
from popsim.geometry.extent import CHUNK, extent

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
    finite = np.asarray(np.isfinite(corners.reshape(-1, 9)).all(axis=1))
    if not finite.any():
        raise MeshError(f"{path.name}: all {len(corners)} faces have coordinates that are not numbers")
    whole = corners if finite.all() else corners[finite]
    low, high = extent(whole.reshape(-1, 3))
    with np.errstate(over="ignore"):
        size = float((high - low).max())
    if not np.isfinite(size):
        raise MeshError(f"{path.name}: coordinates reach {np.abs([low, high]).max():.3g}, too far for arithmetic")
    if size == 0.0:
        raise MeshError(f"{path.name}: all points of its faces coincide; a pop-up needs a surface")
    keep = finite.copy()
    doubled, has_area = _areas(whole, low, size)
    keep[finite] = has_area
    if not keep.any() or (doubled.max() <= LINE and _on_a_line((whole[has_area] - low) / size)):
        raise MeshError(f"{path.name}: all points of its faces lie on one line; a pop-up needs a surface")
    return keep, _notes(int((~finite).sum()), int((finite & ~keep).sum()))


def _areas(corners: FloatArray, low: FloatArray, size: float) -> tuple[FloatArray, BoolArray]:
    """Return the doubled area of each triangle (m,) in units of `size`, and whether it is one, and not a line."""
    doubled, has_area = np.empty(len(corners)), np.empty(len(corners), dtype=bool)
    for start in range(0, len(corners), CHUNK):
        part = slice(start, start + CHUNK)
        unit = (corners[part] - low) / size
        first, second = unit[:, 1] - unit[:, 0], unit[:, 2] - unit[:, 0]
        doubled[part] = np.linalg.norm(cross(first, second), axis=1)
        longest = np.max([np.square(edge).sum(axis=1) for edge in (first, second, second - first)], axis=0)
        has_area[part] = doubled[part] > FLATNESS * longest
    return doubled, has_area


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

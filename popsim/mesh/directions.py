"""Dominant directions of a surface: NPCA over its normals, or its long edges (Sec. 4.1).

The normals of a block-like model point in few directions; the one with the most area is the principal axis.
Normals that differ in sign count as equal. Directions are found by the weight within a few degrees, then
made exact by the mean of what lies within one degree, so that a turned model gives a turned answer.
"""

from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.geometry.weld import near_corner_numbers
from popsim.mesh.sampling import Samples, face_normals

BINS = 1800
"""Histogram bins over a quarter turn: 0.05 degrees each."""
SPREAD = np.radians(1.5)
"""Standard deviation with which directions are taken to be the same."""
WINDOW = np.radians(1.0)
"""Directions within it of a peak take part in its mean."""
RIVAL = 0.7
"""Peaks of at least this share of the highest one are offered too."""
RIVALS = 4
VAGUE = 0.3
"""If the best heading stands out less than this, that of the model's own axes is offered too."""
CANDIDATES = 400
"""Normals that are tried as principal axis; samples are spread evenly, so every large face is among them."""
WALL = 0.9
"""Faces whose normal has a horizontal part above this are walls."""
STEEP = 0.5
"""Normals whose horizontal part is shorter say little about the heading."""
SHARP = np.cos(np.radians(30))
"""Edges between faces that turn less are rounding or triangulation, not edges of the shape."""
NEAR = np.cos(np.radians(4))
"""Normals within 4 degrees of an axis belong to it."""


class Peak(NamedTuple):
    """A horizontal direction and its perpendicular.

    `angle` is in radians, 0 <= angle < pi / 2, counterclockwise from the first horizontal axis. `strength`,
    0..1, is near 0 if no heading stands out (a ball) and near 1 for the main one of a block.
    """

    angle: float
    strength: float


def horizontal_basis(up: FloatArray) -> FloatArray:
    """Return rows e1, e2, up, right-handed, where e1 follows a model axis as nearly as it can; shape (3, 3)."""
    nearest = int(np.abs(up).argmin())
    first = np.eye(3)[nearest] - up[nearest] * up
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(up, first), up])


def turned_basis(basis: FloatArray, angle: float) -> FloatArray:
    """Return `basis` (3, 3) turned about its last row by `angle`, counterclockwise seen from there."""
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.concatenate([turn @ basis[:2], basis[2:]])


def normal_headings(surface: Surface, basis: FloatArray) -> list[Peak]:
    """Return headings by the area of the normals (NPCA about the up axis), the strongest first.

    Parameters
    ----------
    surface:
        In any frame.
    basis:
        Two horizontal unit vectors and the up axis in its frame, as rows, shape (3, 3).
    """
    normals, areas = face_normals(surface)
    flat = normals @ basis[:2].T
    length = np.linalg.norm(flat, axis=1)
    return _headings(np.arctan2(flat[:, 1], flat[:, 0]), np.where(length > STEEP, areas * length, 0.0))


def edge_headings(surface: Surface, basis: FloatArray) -> list[Peak]:
    """Return headings by the long edges of the shape, strongest first; see :func:`normal_headings`.

    Edges count with the square of their length: one long edge says more than many short ones.
    """
    vectors = _shape_edges(surface)
    flat = vectors @ basis[:2].T
    length = np.linalg.norm(flat, axis=1)
    level = length > STEEP * np.linalg.norm(vectors, axis=1)
    return _headings(np.arctan2(flat[:, 1], flat[:, 0]), np.where(level, length**2, 0.0))


def principal_axes(samples: Samples) -> FloatArray:
    """Return the NPCA frame in space: three orthonormal rows, the strongest direction first, shape (3, 3)."""
    normals, area = samples.normals, samples.area
    first = _mean_direction(normals, area, _strongest(normals, normals, area))
    level = normals - (normals @ first)[:, None] * first
    length = np.linalg.norm(level, axis=1)
    sideways = np.flatnonzero(length > NEAR)
    if not len(sideways):  # a flat sheet: any direction in it will do
        level, length, sideways = np.eye(3) - np.outer(first, first), np.ones(3), np.arange(3)
        area = np.linalg.norm(level, axis=1)
        normals = level
    unit = level[sideways] / np.linalg.norm(level[sideways], axis=1).clip(1e-12)[:, None]
    weight = area[sideways] * length[sideways]
    second = _mean_direction(unit, weight, _strongest(unit, unit, weight))
    second = second - (second @ first) * first
    second /= np.linalg.norm(second)
    return np.stack([first, second, np.cross(first, second)])


def inertia_axes(samples: Samples) -> FloatArray:
    """Return the principal axes of inertia of the surface, orthonormal rows, shape (3, 3)."""
    weight = samples.area / samples.area.sum()
    away = samples.points - weight @ samples.points
    axes: FloatArray = np.linalg.eigh((away * weight[:, None]).T @ away)[1].T
    return axes


def axes_about(samples: Samples, axis: int) -> FloatArray:
    """Return coordinate axis `axis` (0..2) and the two directions across it that most normals follow, (3, 3)."""
    up = np.eye(3)[axis]
    level = samples.normals - samples.normals[:, [axis]] * up
    length = np.linalg.norm(level, axis=1)
    wall = length > WALL
    if not wall.any():
        return np.eye(3)
    walls = level[wall] / length[wall, None]
    tried = walls[:: len(walls) // CANDIDATES + 1]
    along = np.abs(tried @ walls.T)
    either = np.maximum(along, np.sqrt(np.clip(1 - along**2, 0, 1)))  # a heading and its perpendicular
    first = tried[((either > NEAR) @ samples.area[wall]).argmax()]
    return np.stack([first, np.cross(up, first), up])


def axis_share(samples: Samples, axes: FloatArray) -> float:
    """Return the share of the area, 0..1, whose normal is near one of the rows of `axes`."""
    near = (np.abs(samples.normals @ axes.T) > NEAR).any(axis=1)
    return float(samples.area[near].sum() / samples.area.sum())


def _headings(angles: FloatArray, weights: FloatArray) -> list[Peak]:
    quarter = np.pi / 2
    angles = np.mod(angles, quarter)
    if not weights.sum() > 0:
        return [Peak(0.0, 1.0)]
    counts, _ = np.histogram(angles, BINS, range=(0, quarter), weights=weights)
    offset = (np.arange(BINS) + BINS // 2) % BINS - BINS // 2
    kernel = np.exp(-(((offset * quarter / BINS) / SPREAD) ** 2) / 2)
    smooth = np.fft.irfft(np.fft.rfft(counts) * np.fft.rfft(kernel), BINS)
    peak = (smooth >= np.roll(smooth, 1)) & (smooth > np.roll(smooth, -1)) & (smooth >= RIVAL * smooth.max())
    best = sorted(np.flatnonzero(peak), key=lambda k: -smooth[k])[:RIVALS]
    contrast = 1 - smooth.mean() / smooth.max()
    strength = contrast * smooth / smooth.max()
    own = [Peak(0.0, float(strength[0]))] if contrast < VAGUE else []
    return [Peak(_mean_angle(angles, weights, (k + 0.5) * quarter / BINS), float(strength[k])) for k in best] + own


def _mean_angle(angles: FloatArray, weights: FloatArray, start: float) -> float:
    quarter = np.pi / 2
    away = np.mod(angles - start + quarter / 2, quarter) - quarter / 2
    near = np.where(np.abs(away) < WINDOW, weights, 0.0)
    if not near.sum() > 0:
        return start
    angle = float(np.mod(start + (near @ away) / near.sum(), quarter))
    return 0.0 if quarter - angle < 1e-9 else angle


def _strongest(candidates: FloatArray, normals: FloatArray, weights: FloatArray) -> FloatArray:
    """Return the candidate that most weight is parallel to, up to sign."""
    tried = candidates[:: len(candidates) // CANDIDATES + 1]
    sine_squared = 1 - (tried @ normals.T) ** 2
    best: FloatArray = tried[(np.exp(-sine_squared / (2 * (2 * SPREAD) ** 2)) @ weights).argmax()]
    return best


def _mean_direction(normals: FloatArray, weights: FloatArray, start: FloatArray) -> FloatArray:
    along = normals @ start
    near = np.abs(along) > np.cos(2 * WINDOW)
    mean = (weights[near] * np.sign(along[near])) @ normals[near]
    return np.asarray(mean / np.linalg.norm(mean))


def _shape_edges(surface: Surface) -> FloatArray:
    """Vectors (k, 3) of the edges at which the surface turns or ends."""
    corners = surface.triangles
    point = near_corner_numbers(corners)
    ends = np.stack([point, np.roll(point, -1, axis=1)], axis=-1).reshape(-1, 2)
    ends.sort(axis=1)
    vectors = (np.roll(corners, -1, axis=1) - corners).reshape(-1, 3)
    normals = np.repeat(face_normals(surface)[0], 3, axis=0)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends, vectors, normals = ends[order], vectors[order], normals[order]
    first = np.r_[True, (ends[1:] != ends[:-1]).any(axis=1)]
    group = np.cumsum(first) - 1
    flatness = np.full(group[-1] + 1, 1.0)
    np.minimum.at(flatness, group, np.abs(np.einsum("ij,ij->i", normals, normals[first][group])))
    single = np.bincount(group) == 1
    return np.asarray(vectors[first][single | (flatness < SHARP)])

"""Points evenly spread over a surface, whatever its triangles are like (Sec. 4.1, [SLCH11]).

A grid of cubes is laid over the model. The part of the surface that lies in one cube and faces one of the six
directions of the grid becomes one point, at the centroid of that part and weighted by its area: a box of 12
triangles and the same box of 100,000 give the same points, for neither cubes nor parts depend on how the
surface is cut up. Areas are gathered by spreading many probes over each triangle.
"""

from dataclasses import dataclass

import numpy as np

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, IntArray, locked
from popsim.geometry.extent import CHUNK
from popsim.geometry.surface import Surface

PROBES_PER_CELL = 32
"""Probes per cell face of area: centroids are then good to a few hundredths of a cell."""
PROBES_PER_LENGTH = 3
"""Probes per cell along the longest edge of a triangle, so that slivers are followed too."""
MAX_PROBES = 6_000_000
"""Bound on memory (about 100 bytes each); probes get sparser beyond it."""
SMALL_PART = 0.25
"""Parts below this share of a cell face join the nearest larger one that faces the same way."""
_TIE = np.array([3e-6, 2e-6, 1e-6])
"""Keeps normals at exactly 45 degrees from flickering between two directions by rounding."""


@dataclass(frozen=True, eq=False)
class Samples:
    """`n` points of a surface, in its frame and unit.

    Attributes
    ----------
    points:
        Shape (n, 3).
    normals:
        Unit normals of the faces they lie on, shape (n, 3).
    face:
        Index of that face, shape (n,).
    area:
        Area that each point stands for, shape (n,); the sum is the area of the surface.
    spacing:
        Edge of the grid cubes: the typical distance of neighbours.
    """

    points: FloatArray
    normals: FloatArray
    face: IntArray
    area: FloatArray
    spacing: float

    def __post_init__(self) -> None:
        count = len(self.points)
        object.__setattr__(self, "points", locked(self.points, (count, 3), "sample points"))
        object.__setattr__(self, "normals", locked(self.normals, (count, 3), "sample normals"))
        object.__setattr__(self, "area", locked(self.area, (count,), "sample areas"))
        face = np.array(self.face, dtype=np.int64)
        face.setflags(write=False)
        object.__setattr__(self, "face", face)

    def moved(self, matrix: FloatArray) -> "Samples":
        """Return the samples moved by the rigid motion `matrix` (4, 4)."""
        turn = matrix[:3, :3].T
        points = self.points @ turn + matrix[:3, 3]
        return Samples(points, self.normals @ turn, self.face, self.area, self.spacing)


def face_normals(surface: Surface) -> tuple[FloatArray, FloatArray]:
    """Return unit normals (m, 3), zero where a face has no area, and areas (m,)."""
    return surface.normals, surface.areas


def spread(samples: Samples, bounds: FloatArray, count: int, seed: int) -> FloatArray:
    """Draw points within a box, rows low and high (2, 3), as often as their area says; shape (count, 3)."""
    inside = np.flatnonzero(((samples.points >= bounds[0]) & (samples.points <= bounds[1])).all(axis=1))
    area = samples.area[inside]
    drawn = np.random.default_rng(seed).choice(inside, count, p=area / area.sum())
    return np.asarray(samples.points[drawn])


def sample_surface(surface: Surface, count: int, *, seed: int) -> Samples:
    """Spread about `count` points evenly over a surface.

    Parameters
    ----------
    surface:
        In any frame; the result is in the same one. Faces without an area get no points.
    count:
        Wanted number of points. Surfaces with much detail below the spacing get more, double walls fewer.
    seed:
        Places the grid; the same seed gives the same points.

    Raises
    ------
    GeometryError
        `count` is not positive, or the surface has no area.
    """
    if count < 1:
        raise GeometryError(f"cannot spread {count} points over a surface; give at least 1")
    normals, areas = face_normals(surface)
    if not areas.sum() > 0:
        raise GeometryError("cannot spread points over a surface without an area")
    # a plane with normal n meets |n_x| + |n_y| + |n_z| cells per cell face of its area
    spacing = float(np.sqrt((areas * np.abs(normals).sum(axis=1)).sum() / count))
    face, probes = _probes(surface.triangles, areas, spacing)
    share = areas[face] / np.bincount(face)[face]
    origin = surface.bounds[0] - spacing * np.random.default_rng(seed).uniform(0.2, 0.8, 3)
    facing = _facing(normals)
    part = _parts(np.floor((probes - origin) / spacing).astype(np.int64), facing[face])
    centroid, area = _means(part, probes, share)
    part = _merge_small(centroid, area, _first(part, facing[face]), spacing)[part]
    centroid, area = _means(part, probes, share)
    near = _nearest_probe(part, probes, centroid)
    flat = normals[face[near]]
    # the centroid of a curved part, or of two sheets in one cell, lies off the surface: back onto a face
    offset = np.einsum("ij,ij->i", probes[near] - centroid, flat)
    return Samples(centroid + offset[:, None] * flat, flat, face[near], area, spacing)


def _probes(corners: FloatArray, areas: FloatArray, spacing: float) -> tuple[IntArray, FloatArray]:
    """Return the face of each probe (p,) and the probes (p, 3): at least one on every triangle with an area."""
    reach = _longest_edges(corners) * PROBES_PER_LENGTH / spacing
    counts = np.maximum(areas * PROBES_PER_CELL / spacing**2, reach)
    counts = np.maximum(np.ceil(counts * min(1.0, MAX_PROBES / counts.sum())).astype(np.int64), 1)
    counts[areas == 0] = 0  # a cell that only such faces reach would have no centroid
    one, many = np.flatnonzero(counts == 1), np.flatnonzero(counts > 1)
    face, probes = _strata(corners[many], counts[many])
    return np.concatenate([one, many[face]]), np.concatenate([corners[one].mean(axis=1), probes])


def _longest_edges(corners: FloatArray) -> FloatArray:
    longest = np.empty(len(corners))
    for start in range(0, len(corners), CHUNK):
        part = corners[start : start + CHUNK]
        squares = [np.square(part[:, k] - part[:, k - 1]).sum(axis=1) for k in range(3)]
        longest[start : start + CHUNK] = np.max(squares, axis=0)
    return np.sqrt(longest, out=longest)


def _strata(corners: FloatArray, counts: IntArray) -> tuple[IntArray, FloatArray]:
    """Return the face of each probe (p,) and the probes (p, 3), stratified along the longest edge."""
    edges = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(edges, axis=2)
    start = lengths.argmax(axis=1)
    rows = np.arange(len(corners))
    longest = lengths[rows, start]
    face = np.repeat(rows, counts)
    order = np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts)
    first, second = corners[rows, start], corners[rows, (start + 1) % 3]
    apex = corners[rows, (start + 2) % 3]
    along = second - first
    foot = np.einsum("ij,ij->i", apex - first, along) / np.maximum(longest, 1e-300) ** 2
    height = apex - first - foot[:, None] * along
    position, reach = _triangle_strata((order + 0.5) / counts[face], np.clip(foot, 0, 1)[face])
    across = _radical_inverse(order) * reach
    return face, first[face] + position[:, None] * along[face] + across[:, None] * height[face]


def _triangle_strata(level: FloatArray, foot: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Position along the base below which the share `level` of a triangle's area lies, and the height there.

    The base has length 1, the apex height 1 above `foot`.
    """
    rising = level < foot
    position = np.where(rising, np.sqrt(level * foot), 1 - np.sqrt((1 - level) * (1 - foot)))
    reach = np.where(rising, position / np.maximum(foot, 1e-12), (1 - position) / np.maximum(1 - foot, 1e-12))
    return position, np.clip(reach, 0, 1)


def _radical_inverse(order: IntArray) -> FloatArray:
    """Van der Corput sequence in base 2, moved off zero by half the last digit."""
    digits = order.copy()
    value = np.zeros(len(order))
    scale = 0.5
    while digits.any():
        value += scale * (digits & 1)
        digits >>= 1
        scale /= 2
    return value + scale


def _facing(normals: FloatArray) -> IntArray:
    """Which of the six grid directions a face looks at, 0..5."""
    axis: IntArray = (np.abs(normals) + _TIE).argmax(axis=1)
    negative = normals[np.arange(len(normals)), axis] < 0
    return axis + 3 * negative


def _parts(cell: IntArray, facing: IntArray) -> IntArray:
    """Number the pairs of cell (p, 3) and facing (p,) that occur, in lexicographic order."""
    extent = cell.max(axis=0) + 1
    key = ((cell[:, 0] * extent[1] + cell[:, 1]) * extent[2] + cell[:, 2]) * 6 + facing
    number: IntArray = np.unique(key, return_inverse=True)[1]
    return number


def _means(part: IntArray, probes: FloatArray, share: FloatArray) -> tuple[FloatArray, FloatArray]:
    area = np.asarray(np.bincount(part, weights=share), dtype=np.float64)
    sums = np.stack([np.bincount(part, weights=share * probes[:, k]) for k in range(3)], axis=1)
    return sums / area[:, None], area


def _first(part: IntArray, values: IntArray) -> IntArray:
    """Return the value of the first probe of each part."""
    firsts = np.empty(part.max() + 1, dtype=values.dtype)
    firsts[part[::-1]] = values[::-1]  # the last that is written stays
    return firsts


def _merge_small(centroid: FloatArray, area: FloatArray, facing: IntArray, spacing: float) -> IntArray:
    """Return the new number of each part once small ones have joined a neighbour within one cell."""
    from scipy.spatial import cKDTree  # slow import

    target = np.arange(len(area))
    small = area < SMALL_PART * spacing**2
    for side in range(6):
        little, large = (np.flatnonzero((facing == side) & mask) for mask in (small, ~small))
        if len(little) and len(large):
            distance, index = cKDTree(centroid[large]).query(centroid[little])
            close = distance < spacing
            target[little[close]] = large[index[close]]
    number: IntArray = np.unique(target, return_inverse=True)[1]
    return number


def _nearest_probe(part: IntArray, probes: FloatArray, centroid: FloatArray) -> IntArray:
    """Return the index of the probe of each part that is nearest to its centroid, the first of equals."""
    distance = np.square(probes - centroid[part]).sum(axis=1)
    least = np.full(len(centroid), np.inf)
    np.minimum.at(least, part, distance)
    nearest = np.flatnonzero(distance == least[part])
    return _first(part[nearest], nearest)

"""The level frame: up is known, and the model is turned about it in a way that depends on its shape alone.

All that is found by samples is found in this frame, so that the same model gives the same answer however it lies
in its file.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.extent import extent
from popsim.geometry.surface import Surface
from popsim.mesh.bounds import Body, body_of
from popsim.mesh.directions import Peak, turned_basis
from popsim.mesh.sampling import Samples, face_normals, sample_surface
from popsim.mesh.symmetry import MirrorSearch

SQUARE = 1.02
"""Sides whose ratio is below this are equally long."""
LEAN = 1e-6
"""Means (relative to the extents) nearer to the middle are noise."""


@dataclass(frozen=True, eq=False)
class Level:
    """A model that stands upright.

    Attributes
    ----------
    rotation:
        Model coordinates to the level frame: rows are its axes, the last one up; shape (3, 3).
    surface, samples:
        The model, and points on it, in the level frame.
    peaks:
        Headings that its shape suggests, counterclockwise from the first axis of the level frame.
    """

    rotation: FloatArray
    surface: Surface
    samples: Samples
    peaks: tuple[Peak, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "rotation", locked(self.rotation, (3, 3), "level rotation"))

    @cached_property
    def search(self) -> MirrorSearch:
        """For mirror planes of the samples."""
        return MirrorSearch(self.samples)

    @cached_property
    def body(self) -> Body:
        """What counts of the model."""
        return body_of(self.surface, self.samples)


def levelled(surface: Surface, basis: FloatArray, peaks: list[Peak], count: int, seed: int) -> Level:
    """Turn a model upright.

    Parameters
    ----------
    surface:
        In model coordinates.
    basis:
        Two horizontal unit vectors and the up axis there, as rows, shape (3, 3).
    peaks:
        Headings by the shape, relative to `basis`; the level frame follows the first.
    count, seed:
        Of the samples.
    """
    first = peaks[0].angle
    rotation = _canonical(surface, turned_basis(basis, first))
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    stands = surface.transformed(matrix)
    own = tuple(Peak(float(np.mod(peak.angle - first, np.pi / 2)), peak.strength) for peak in peaks)
    return Level(rotation, stands, sample_surface(stands, count, seed=seed), own)


def lean(surface: Surface, axis: FloatArray) -> float:
    """Return how far the middle of the area lies off the middle of the extent along an axis (3,), -0.5..0.5.

    Exact, whatever the samples; 0 where it is noise.
    """
    low, high = _extent(surface, axis)
    areas = face_normals(surface)[1]
    middle = float(areas @ (surface.triangles @ axis).mean(axis=1)) / float(areas.sum())
    off = (middle - (low + high) / 2) / max(high - low, 1e-300)
    return off if abs(off) > LEAN else 0.0


def _canonical(surface: Surface, basis: FloatArray) -> FloatArray:
    """Return the frame turned by quarters: x along the longer or more uneven side, to the end with more area."""
    sizes = [high - low for low, high in (_extent(surface, axis) for axis in basis[:2])]
    leans = [lean(surface, axis) for axis in basis[:2]]
    longer = int(np.argmax(sizes))
    if max(sizes) < SQUARE * min(sizes):
        longer = int(abs(leans[1]) > abs(leans[0]) + LEAN)
    x = basis[longer] * (-1.0 if leans[longer] < 0 else 1.0)
    return np.stack([x, np.cross(basis[2], x), basis[2]])


def _extent(surface: Surface, axis: FloatArray) -> tuple[float, float]:
    low, high = extent(surface.triangles.reshape(-1, 3), axis[None])[:, 0]
    return float(low), float(high)

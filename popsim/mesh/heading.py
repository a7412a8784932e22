"""How a model is turned about the up axis: its two horizontal directions and the mirror planes across them."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.mesh.bounds import robust_bounds
from popsim.mesh.directions import Peak, edge_headings, normal_headings
from popsim.mesh.sampling import Samples, sample_surface
from popsim.mesh.symmetry import MirrorPlane, MirrorSearch

SYMMETRY_WEIGHT, BOX_WEIGHT = 2.0, 0.5
"""Weights of the mirror score and of the tightness of the box beside the strength of a heading."""
HARDLY_SYMMETRIC = 0.8
"""Below this mirror score at every dominant heading, planes at all headings are tried too."""
OFF_PEAK = 0.5
"""Share of the first peak's strength that is granted to a heading away from every peak."""
COARSE_SAMPLES = 700
COARSE_STEP = np.radians(5.0)
FINE_STEPS = np.radians([2.0, 1.0, 0.5])


@dataclass(frozen=True, eq=False)
class Heading:
    """Two perpendicular horizontal directions of a model.

    Attributes
    ----------
    directions:
        Unit vectors in model coordinates, the second a quarter turn counterclockwise (seen from above) of the
        first: shape (2, 3).
    planes:
        The best mirror plane across each of them.
    extents:
        Size of the robust box along each.
    reason:
        One sentence.
    """

    directions: FloatArray
    planes: tuple[MirrorPlane, MirrorPlane]
    extents: tuple[float, float]
    reason: str


class _Turntable(NamedTuple):
    """A model that can be turned about its up axis: `basis` holds two horizontal axes and up, as rows."""

    surface: Surface
    samples: Samples
    search: MirrorSearch
    basis: FloatArray

    def heading(self, angle: float, reason: str) -> Heading:
        directions = _directions(self.basis, angle)
        matrix = np.eye(4)
        matrix[:2, :3], matrix[2, :3] = directions, self.basis[2]
        low, high = robust_bounds(self.surface.transformed(matrix), self.samples.moved(matrix)).bounds
        first, second = (self.search.best_plane(directions[k], (float(low[k]), float(high[k]))) for k in range(2))
        extents = float(high[0] - low[0]), float(high[1] - low[1])
        return Heading(directions, (first, second), extents, reason)


def choose_heading(surface: Surface, samples: Samples, up: FloatArray, method: str) -> Heading:
    """Choose the heading that is strong, symmetric and has a tight bounding box (Sec. 4.1).

    Parameters
    ----------
    surface, samples:
        The model, and points on it in the same frame.
    up:
        Unit vector, shape (3,).
    method:
        "npca", "edges" or "none"; see :func:`popsim.mesh.alignment.align`.
    """
    basis = horizontal_basis(up)
    table = _Turntable(surface, samples, MirrorSearch(samples), basis)
    if method == "none":
        return table.heading(0.0, "the heading is that of the model's own axes")
    peaks = normal_headings(surface, basis) if method == "npca" else edge_headings(surface, basis)
    words = f"the heading is that of {'most of the normals (NPCA)' if method == 'npca' else 'the long edges'}"
    found = [table.heading(peak.angle, words) for peak in peaks]
    if max(_symmetry(heading) for heading in found) < HARDLY_SYMMETRIC:
        angle = _most_symmetric_angle(table)
        if min(_apart(angle, peak.angle) for peak in peaks) > COARSE_STEP / 2:
            peaks.append(Peak(angle, OFF_PEAK * peaks[0].strength))
            found.append(table.heading(angle, "the heading is that of the best mirror plane"))
    areas = [heading.extents[0] * heading.extents[1] for heading in found]
    merit = [
        peak.strength + SYMMETRY_WEIGHT * _symmetry(heading) + BOX_WEIGHT * min(areas) / max(area, 1e-300)
        for peak, heading, area in zip(peaks, found, areas, strict=True)
    ]
    return found[int(np.argmax(merit))]


def horizontal_basis(up: FloatArray) -> FloatArray:
    """Return rows e1, e2, up, right-handed, where e1 follows a model axis as nearly as it can; shape (3, 3)."""
    nearest = int(np.abs(up).argmin())
    first = np.eye(3)[nearest] - up[nearest] * up
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(up, first), up])


def _directions(basis: FloatArray, angle: float) -> FloatArray:
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.asarray(turn @ basis[:2])


def _symmetry(heading: Heading) -> float:
    return max(plane.score for plane in heading.planes)


def _apart(angle: float, other: float) -> float:
    """Angle between two headings, which repeat every quarter turn."""
    quarter = np.pi / 2
    return float(abs(np.mod(angle - other + quarter / 2, quarter) - quarter / 2))


def _most_symmetric_angle(table: _Turntable) -> float:
    """Return the angle, 0..pi/2, of a heading of which one mirror plane is the best of all vertical ones."""
    coarse_samples = sample_surface(table.surface, COARSE_SAMPLES, seed=0)
    coarse = table._replace(samples=coarse_samples, search=MirrorSearch(coarse_samples))
    angles = np.arange(0.0, np.pi, COARSE_STEP)
    angle = float(angles[int(np.argmax([_score_across(coarse, a) for a in angles]))])
    for step in FINE_STEPS:
        trials = [angle - step, angle, angle + step]
        angle = trials[int(np.argmax([_score_across(table, trial) for trial in trials]))]
    return float(np.mod(angle, np.pi / 2))


def _score_across(table: _Turntable, angle: float) -> float:
    normal = _directions(table.basis, angle)[0]
    along = table.samples.points @ normal
    return table.search.best_plane(normal, (float(along.min()), float(along.max())), quick=True).score

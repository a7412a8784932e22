"""How a model is turned about the up axis: its two horizontal directions and the mirror planes across them."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mesh.directions import Peak, turned_basis
from popsim.mesh.level import Level
from popsim.mesh.sampling import Samples, sample_surface
from popsim.mesh.symmetry import MirrorPlane, MirrorSearch

SYMMETRY_WEIGHT, BOX_WEIGHT = 2.0, 0.5
"""Weights of the mirror score and of the tightness of the box beside the strength of a heading."""
SURE = 6.0
"""Sharpness of the confidence: a heading whose merit is better by 0.5 than another's is 20 times as likely."""
HARDLY_SYMMETRIC = 0.8
"""Below this mirror score at every dominant heading, planes at all headings are tried too."""
OFF_PEAK = 0.5
"""Share of the first peak's strength that is granted to a heading away from every peak."""
COARSE_SAMPLES = 700
COARSE_STEP = np.radians(5.0)
FINE_STEPS = np.radians([2.0, 1.0, 0.5])


@dataclass(frozen=True, eq=False)
class Heading:
    """Two perpendicular horizontal directions of a model, in the level frame.

    Attributes
    ----------
    directions:
        Unit vectors, the second a quarter turn counterclockwise (seen from above) of the first: shape (2, 3).
    planes:
        The best mirror plane across each of them.
    extents:
        Size of the robust box along each.
    confidence:
        0..1, against the other headings that were tried.
    """

    directions: FloatArray
    planes: tuple[MirrorPlane, MirrorPlane]
    extents: tuple[float, float]
    confidence: float


def choose_heading(level: Level, *, fixed: bool) -> Heading:
    """Choose the heading that is strong, symmetric and has a tight bounding box (Sec. 4.1).

    Parameters
    ----------
    level:
        The model, upright, with the headings that its shape suggests.
    fixed:
        Take the first of these whatever the shape.
    """
    if fixed:
        return _heading(level, 0.0, 1.0)
    peaks = list(level.peaks)
    found = [_heading(level, peak.angle, 0.0) for peak in peaks]
    if max(_symmetry(heading) for heading in found) < HARDLY_SYMMETRIC:
        angle = _most_symmetric_angle(level)
        if min(_apart(angle, peak.angle) for peak in peaks) > COARSE_STEP / 2:
            peaks.append(Peak(angle, OFF_PEAK * peaks[0].strength))
            found.append(_heading(level, angle, 0.0))
    areas = [heading.extents[0] * heading.extents[1] for heading in found]
    tight = min(areas) / np.maximum(areas, 1e-300)
    strength = np.array([peak.strength for peak in peaks])
    merit = strength + SYMMETRY_WEIGHT * np.array([_symmetry(heading) for heading in found]) + BOX_WEIGHT * tight
    best = int(np.argmax(merit))
    confidence = float(1 / np.exp(SURE * (merit - merit[best])).sum())
    return Heading(found[best].directions, found[best].planes, found[best].extents, confidence)


def _heading(level: Level, angle: float, confidence: float) -> Heading:
    frame = turned_basis(np.eye(3), angle)
    low, high = level.body.box(frame).bounds
    first, second = (level.search.best_plane(frame[k], (float(low[k]), float(high[k]))) for k in range(2))
    extents = float(high[0] - low[0]), float(high[1] - low[1])
    return Heading(frame[:2], (first, second), extents, confidence)


def _symmetry(heading: Heading) -> float:
    return max(plane.score for plane in heading.planes)


def _apart(angle: float, other: float) -> float:
    """Angle between two headings, which repeat every quarter turn."""
    quarter = np.pi / 2
    return float(abs(np.mod(angle - other + quarter / 2, quarter) - quarter / 2))


def _most_symmetric_angle(level: Level) -> float:
    """Return the angle, 0..pi/2, of a heading of which one mirror plane is the best of all vertical ones."""
    coarse = sample_surface(level.surface, COARSE_SAMPLES, seed=0)
    search = MirrorSearch(coarse)
    angles = np.arange(0.0, np.pi, COARSE_STEP)
    angle = float(angles[int(np.argmax([_score_across(coarse, search, a) for a in angles]))])
    for step in FINE_STEPS:
        trials = [angle - step, angle, angle + step]
        scores = [_score_across(level.samples, level.search, trial) for trial in trials]
        angle = trials[int(np.argmax(scores))]
    return float(np.mod(angle, np.pi / 2))


def _score_across(samples: Samples, search: MirrorSearch, angle: float) -> float:
    normal = turned_basis(np.eye(3), angle)[0]
    along = samples.points @ normal
    return search.best_plane(normal, (float(along.min()), float(along.max())), quick=True).score

"""Flat things that are alike on both sides, a ring, a gear or a medal, are set on their edge.

They lie in their files because they were drawn or are printed lying. On a card they would hardly rise from the
page, and their outline, which is what they are known by, would be seen by nobody.
"""

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.mesh.axes import ASKEW, axis_name
from popsim.mesh.directions import horizontal_basis, normal_headings, turned_basis
from popsim.mesh.sampling import Samples
from popsim.mesh.symmetry import MirrorSearch
from popsim.mesh.up_axis import UpChoice

FLAT = 0.15
"""Thickness over the shorter side below which a thing is flat."""

ALIKE = 0.9
"""Mirror score across the middle of its thickness above which its two sides are alike."""

EITHER_WAY = 0.5
"""Confidence: whether it should stand or lie is a matter of taste."""

SQUARE = 1.02
"""Sides whose ratio is below this are equally long."""

FOOT = 0.03
"""Share of the height that counts as foot."""


def set_on_edge(surface: Surface, samples: Samples, lying: UpChoice) -> UpChoice:
    """Return the direction that is up when a flat thing stands on its edge; `lying` for all others.

    It stands on its longer side, and of two ends on the wider one.

    Parameters
    ----------
    surface, samples:
        The model, and points on it in the same frame.
    lying:
        The direction that was found to be up.
    """
    basis = horizontal_basis(lying.direction)
    axes = turned_basis(basis, normal_headings(surface, basis)[0].angle)
    points = samples.points @ axes.T
    low, high = points.min(axis=0), points.max(axis=0)
    length, width, thickness = (float(side) for side in high - low)
    if thickness > FLAT * min(length, width):
        return lying
    score = MirrorSearch(samples).score(axes[2], float(low[2] + high[2]) / 2)
    if score < ALIKE:
        return lying
    height = 0 if length * SQUARE < width else 1
    feet = [_foot(sign * points[:, height], points[:, 1 - height]) for sign in (1, -1)]
    up = axes[height] * (-1.0 if feet[1] > SQUARE * feet[0] else 1.0)
    lies = ",".join(f"{part:.3g}" for part in lying.direction) if lying.name == ASKEW else lying.name
    reason = f"flat and alike on both sides, it is set on its edge; --up {lies} lays it down"
    return UpChoice(up, axis_name(up), EITHER_WAY, f"{lying.reason}; {reason}")


def _foot(heights: FloatArray, along: FloatArray) -> float:
    """How long the foot of points is, whose heights and places along the edge are given."""
    low, high = heights.min(), heights.max()
    return float(np.ptp(along[heights <= low + FOOT * (high - low)]))

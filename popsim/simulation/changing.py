"""Patches that are on one side of another at one recorded angle and on the other side at the next."""

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.candidates import Change
from popsim.simulation.sweep import Sweep


def changed_through(sweep: Sweep, change: Change) -> float:
    """How deep within the outline of one patch the other one changed sides, mm; 0 if around it or through a hole.

    Seen along the normal of the first, before and after the change: of both the less.
    """
    return min(_depth(sweep, change.pair, frame) for frame in (change.before, change.after))


def _depth(sweep: Sweep, pair: tuple[int, int], frame: int) -> float:
    """Greatest distance from the edges of the first patch of what the second one covers of it, mm."""
    from shapely import distance, get_coordinates, make_valid, points

    first, second = (sweep.design.patches[k] for k in pair)
    motion = np.linalg.inv(sweep.poses[frame, pair[0]]) @ sweep.poses[frame, pair[1]]
    plate = first.plane.polygon(first.points, first.hole_points)
    shared = plate.intersection(make_valid(first.plane.polygon(*_moved(second, motion))))
    if shared.is_empty:
        return 0.0
    places = np.concatenate([get_coordinates(shared), get_coordinates(shared.centroid)])
    inside = points(places[[plate.covers(point) for point in points(places)]])
    return float(distance(plate.boundary, inside).max(initial=0.0))


def _moved(patch: Patch, motion: FloatArray) -> tuple[FloatArray, tuple[FloatArray, ...]]:
    """Outline and holes of a patch moved by a rigid motion (4, 4)."""
    return transform(motion, patch.points), tuple(transform(motion, hole) for hole in patch.hole_points)

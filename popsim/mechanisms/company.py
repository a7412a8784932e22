"""Mechanisms together: what stands on one leaves less room to the contours of its plates."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms.base import Mechanism, Plate
from popsim.mechanisms.pair import PairKind

ALONG = 0.99
"""|cos| of a normal to y above which a plate lies along the fold and upright."""


def plates_together(mechanisms: Sequence[Mechanism]) -> dict[str, tuple[Plate, ...]]:
    """The plates of mechanisms with room for all of them, by mechanism id.

    Plates along the fold, sides as well as fins, do not rise over a top in the closing range of what stands on it
    and on that: it would be in the way, and shows the same of the model.

    Parameters
    ----------
    mechanisms:
        Each stands on the card or on an earlier one.
    """
    ranges = _subtree_ranges(mechanisms)
    standing: dict[str, list[Mechanism]] = {mechanism.id: [] for mechanism in mechanisms}
    for mechanism in mechanisms:
        if mechanism.pair.owner in standing and mechanism.pair.kind is PairKind.OPENING:
            standing[mechanism.pair.owner].append(mechanism)
    return {
        mechanism.id: tuple(
            _below(plate, standing[mechanism.id], ranges) if abs(plate.outward[1]) > ALONG else plate
            for plate in plates_of(mechanism)
        )
        for mechanism in mechanisms
    }


@lru_cache(maxsize=1024)
def plates_of(mechanism: Mechanism) -> tuple[Plate, ...]:
    """The plates of a mechanism; searches ask for the same ones again and again."""
    return mechanism.plates()


def _subtree_ranges(mechanisms: Sequence[Mechanism]) -> dict[str, tuple[float, float]]:
    """Union of the closing ranges of each mechanism and all that stands on it, by id."""
    ranges = {mechanism.id: mechanism.closing_range() for mechanism in mechanisms}
    for mechanism in reversed(mechanisms):
        owner = mechanism.pair.owner
        if owner in ranges:
            (low, high), (a, b) = ranges[owner], ranges[mechanism.id]
            ranges[owner] = min(low, a), max(high, b)
    return ranges


def _below(plate: Plate, standing: Sequence[Mechanism], ranges: Mapping[str, tuple[float, float]]) -> Plate:
    """A plate along the fold whose room ends where others stand above it."""
    if not standing or plate.room is None:
        return plate
    from shapely import box as block
    from shapely import union_all
    from shapely.geometry import Polygon

    face, room = (Polygon(ring[:, [0, 2]]) for ring in (plate.outline, plate.room))
    top = room.bounds[3] + 1.0
    taken = union_all([block(ranges[m.id][0], m.pair.v, ranges[m.id][1], top) for m in standing])
    left = union_all([face, room.difference(taken)])
    parts = [part for part in getattr(left, "geoms", [left]) if part.intersects(face)]
    ring: FloatArray = np.array(max(parts, key=lambda part: part.area).exterior.coords)[:-1]
    return replace(plate, room=np.column_stack([ring[:, 0], np.full(len(ring), plate.outline[0, 1]), ring[:, 1]]))

"""Mechanisms together: what stands on one or beside it leaves less room to the contours of its plates."""

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from popsim.mechanisms.base import Mechanism
from popsim.mechanisms.pair import BasePatchPair, PairKind
from popsim.mechanisms.plate import Plate, hinged

ALONG = 0.99
"""|cos| of a normal to y above which a plate lies along the fold and upright."""


SWING = 15.0
"""mm along x that ears swing over while closing."""

Depths = Mapping[str, tuple[float, float]]
"""Factors on how deep behind its face, and how deep beyond it, the model shows on a patch; by patch id."""

AS_THEY_ARE: Depths = {}


def plates_together(mechanisms: Sequence[Mechanism], depths: Depths = AS_THEY_ARE) -> dict[str, tuple[Plate, ...]]:
    """The plates of mechanisms with room for all of them, by mechanism id.

    Plates along the fold, sides as well as fins, do not rise over a top in the closing range of what stands on it
    and on that: it would be in the way, and shows the same of the model. Nor do they reach along the fold into the
    range of what stands beside them on the same pair. Eaves and ears end at the wall of a
    corner in which another mechanism stands, near to that one.

    Parameters
    ----------
    mechanisms:
        Each stands on the card or on an earlier one.
    depths:
        How much deeper than by themselves plates show the model.
    """
    ranges = _subtree_ranges(mechanisms)
    carried: dict[str | None, list[Mechanism]] = {}
    on_pair: dict[tuple[str, str], list[Mechanism]] = {}
    for mechanism in mechanisms:
        carried.setdefault(mechanism.pair.owner, []).append(mechanism)
        on_pair.setdefault(mechanism.pair.patches, []).append(mechanism)
    found = {}
    for owner in mechanisms:
        own = carried.get(owner.id, ())
        corners = tuple(other for other in own if other.pair.kind is PairKind.CORNER)
        above = tuple((*ranges[it.id], it.pair.v) for it in own if it.pair.kind is PairKind.OPENING)
        beside = tuple(ranges[it.id] for it in on_pair[owner.pair.patches] if it is not owner)
        plates = _fitted(owner, corners, beside, above)
        found[owner.id] = tuple(
            _deepened(plate, *depths.get(owner.patch_id(plate.role), (1.0, 1.0))) for plate in plates
        )
    return found


@lru_cache(maxsize=1024)
def _fitted(
    owner: Mechanism,
    corners: tuple[Mechanism, ...],
    beside: tuple[tuple[float, float], ...],
    above: tuple[tuple[float, float, float], ...],
) -> tuple[Plate, ...]:
    """The plates of a mechanism with the room that is left to them.

    Parameters
    ----------
    owner:
        The mechanism.
    corners:
        What stands in its corners.
    beside:
        Ranges (first and last x) of what stands on the same pair.
    above:
        The same of what stands on its tops, and from which height on, mm.
    """

    def fitted(plate: Plate) -> Plate:
        for other in corners:
            if _near(plate, other):
                plate = _before(plate, other.pair)
        if abs(plate.outward[1]) > ALONG:
            plate = _below(_between(plate, beside), above)
        return plate

    return tuple(fitted(plate) for plate in plates_of(owner))


@lru_cache(maxsize=1024)
def plates_of(mechanism: Mechanism) -> tuple[Plate, ...]:
    """The plates of a mechanism with their hinges; searches ask for the same ones again and again."""
    return hinged(mechanism.plates(), mechanism.joints())


def _subtree_ranges(mechanisms: Sequence[Mechanism]) -> dict[str, tuple[float, float]]:
    """Union of the closing ranges of each mechanism and all that stands on it, by id."""
    ranges = {mechanism.id: mechanism.closing_range() for mechanism in mechanisms}
    for mechanism in reversed(mechanisms):
        owner = mechanism.pair.owner
        if owner in ranges:
            (low, high), (a, b) = ranges[owner], ranges[mechanism.id]
            ranges[owner] = min(low, a), max(high, b)
    return ranges


@lru_cache(maxsize=4096)
def _below(plate: Plate, taken: tuple[tuple[float, float, float], ...]) -> Plate:
    """A plate along the fold whose room ends where others stand above it: over some x, from some height on."""
    assert plate.room is not None  # plates give themselves room
    (left, _, _), (right, _, top) = plate.room.min(axis=0).tolist(), plate.room.max(axis=0).tolist()
    near = [(x0, x1, z) for x0, x1, z in taken if x0 < right and x1 > left and z < top]
    return plate.but(taken=np.array(near)) if near else plate


@lru_cache(maxsize=4096)
def _between(plate: Plate, taken: tuple[tuple[float, float], ...]) -> Plate:
    """A plate along the fold whose room ends where others stand on the same pair beside it."""
    if not taken or plate.room is None:
        return plate
    x = plate.outline[:, 0]
    first, last = x.min(), x.max()
    low = max((high for _, high in taken if high <= first), default=-np.inf)
    high = min((low for low, _ in taken if low >= last), default=np.inf)
    room = plate.room.copy()
    room[:, 0] = np.clip(room[:, 0], low, high)
    return plate.but(room=room)


@lru_cache(maxsize=4096)
def _deepened(plate: Plate, behind: float, beside: float) -> Plate:
    """A plate that shows the model so many times as deep behind its face, and beyond it."""
    if behind == beside == 1.0:
        return plate
    return plate.but(behind=behind * plate.behind, beside=beside * plate.beside)


def _near(plate: Plate, child: Mechanism) -> bool:
    """Whether a plate stands beside a mechanism along x, or could swing there."""
    low, high = _along(child)
    x = plate.outline[:, 0]
    return bool(x.min() < high + SWING and x.max() > low - SWING)


@lru_cache(maxsize=1024)
def _along(mechanism: Mechanism) -> tuple[float, float]:
    x = np.concatenate([plate.outline[:, 0] for plate in plates_of(mechanism)])
    return float(x.min()), float(x.max())


@lru_cache(maxsize=4096)
def _before(plate: Plate, corner: BasePatchPair) -> Plate:
    """A plate whose room ends at the wall of a corner; unchanged where it lies beyond."""
    assert plate.room is not None  # plates give themselves room
    left = corner.u - corner.side.value * plate.room[:, 1]
    if left.min() >= 0 or left.max() <= 0:
        return plate
    ring = []
    for here, there, a, b in zip(
        plate.room, np.roll(plate.room, -1, axis=0), left, np.roll(left, -1), strict=True
    ):
        if a >= 0:
            ring.append(here)
        if a * b < 0:
            ring.append(here + (there - here) * (a / (a - b)))
    return plate.but(room=np.array(ring))

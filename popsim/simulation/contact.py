"""Patches that cross, and where in the sweep it is looked for."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.geometry.arrays import IntArray
from popsim.simulation.sweep import Sweep

STACKED_DEGREES = 1.0
"""Below this fold angle the card counts as closed: patches lie on each other, and what crossed before matters."""

Depths = dict[tuple[str, str], dict[int, float]]
"""How far patches reach through each other, mm, by their ids and the position of the recorded angle."""


@dataclass(frozen=True)
class Contact:
    """Two patches that cross.

    Attributes
    ----------
    patches:
        Their ids.
    way:
        In which motion of the card.
    frame:
        Position of the first recorded angle at which they cross.
    first:
        Fold angle from which they cross by more than is allowed, rad.
    depth:
        How far one reaches through the other at most, mm.
    deepest:
        Fold angle of that, rad.
    trace:
        Fold angle in rad and depth in mm wherever they cross, in the order of the motion.
    """

    patches: tuple[str, str]
    way: Literal["closing", "opening"]
    frame: int
    first: float
    depth: float
    deepest: float
    trace: tuple[tuple[float, float], ...]


def searched_frames(sweep: Sweep, tolerance: float) -> IntArray:
    """Positions of the recorded angles at which crossings are looked for: not where the card counts as closed.

    All on the way down; on the way up only those at which something is not where it was on the way down: any
    corner by more than half of `tolerance` mm. What is where it was crosses what it crossed.
    """
    counted = sweep.degrees >= STACKED_DEGREES - 1e-9
    closed = sweep.closed
    down = np.flatnonzero(counted[: closed + 1])
    up = np.flatnonzero(counted[closed + 1 :]) + closed + 1
    back = up[2 * closed - up >= 0]
    moved = np.linalg.norm(sweep.places[back] - sweep.places[2 * closed - back], axis=-1).max(axis=1, initial=0.0)
    return np.concatenate([down, back[moved > tolerance / 2]])


def contacts_of(sweep: Sweep, depths: Depths) -> Iterator[Contact]:
    """The contacts that depths make, one for each way in which two patches cross."""
    for patches, found in depths.items():
        down = {frame: depth for frame, depth in found.items() if frame <= sweep.closed}
        up = {frame: depth for frame, depth in found.items() if frame > sweep.closed}
        if down:
            yield _contact(sweep, patches, "closing", down)
        if up:
            yield _contact(sweep, patches, "opening", up)


def _contact(
    sweep: Sweep, patches: tuple[str, str], way: Literal["closing", "opening"], depths: Mapping[int, float]
) -> Contact:
    deepest = max(depths, key=lambda frame: depths[frame])
    trace = tuple((float(sweep.theta[frame]), depths[frame]) for frame in sorted(depths))
    return Contact(patches, way, min(depths), trace[0][0], depths[deepest], float(sweep.theta[deepest]), trace)

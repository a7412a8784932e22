"""Patches that cross, and where in the sweep it is looked for."""

from collections.abc import Mapping
from dataclasses import dataclass

from popsim.simulation.sweep import Sweep

STACKED_DEGREES = 1.0
"""Below this fold angle the card counts as closed: patches lie on each other, and what crossed before matters."""


@dataclass(frozen=True)
class Contact:
    """Two patches that cross.

    Attributes
    ----------
    patches:
        Their ids.
    first:
        Fold angle at which they first cross while closing, rad.
    depth:
        How far one reaches through the other at most, mm.
    deepest:
        Fold angle of that, rad.
    trace:
        Fold angle in rad and depth in mm wherever they cross, while closing.
    """

    patches: tuple[str, str]
    first: float
    depth: float
    deepest: float
    trace: tuple[tuple[float, float], ...]


def closing_frames(sweep: Sweep) -> int:
    """Number of recorded angles, from the open card on, at which crossings count."""
    return int((sweep.degrees[: sweep.closed + 1] >= STACKED_DEGREES - 1e-9).sum())


def contact_of(
    sweep: Sweep, patches: tuple[str, str], depths: Mapping[int, float], tolerance: float
) -> Contact | None:
    """The contact that depths in mm by position of the angle make, or None where none exceeds `tolerance`."""
    crossing = {frame: depth for frame, depth in depths.items() if depth > tolerance}
    if not crossing:
        return None
    deepest = max(crossing, key=lambda frame: crossing[frame])
    trace = tuple((float(sweep.theta[frame]), crossing[frame]) for frame in sorted(crossing))
    return Contact(patches, trace[0][0], crossing[deepest], float(sweep.theta[deepest]), trace)

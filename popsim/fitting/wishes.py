"""What the user's hand has decided before fitting begins: what is kept, and what may not be."""

from dataclasses import dataclass, replace

import numpy as np

from popsim.geometry.arrays import FloatArray, locked
from popsim.mechanisms import Mechanism

TOUCH = 1e-6
"""mm; faces that end this near to a region do not reach into it."""


@dataclass(frozen=True, eq=False)
class Region:
    """A box of space in the open pose: lowest and highest corner, card frame, mm, shape (2, 3); may be endless."""

    bounds: FloatArray

    def __post_init__(self) -> None:
        finite = np.clip(np.asarray(self.bounds, float), -1e6, 1e6)  # arrays at the boundary are finite
        object.__setattr__(self, "bounds", locked(finite, (2, 3), "region"))

    def overlaps(self, mechanism: Mechanism) -> bool:
        """Whether the box around the faces of a mechanism reaches into it."""
        low, high = mechanism.face_box()
        return bool((np.minimum(high, self.bounds[1]) - np.maximum(low, self.bounds[0]) > TOUCH).all())

    def holds(self, mechanism: Mechanism) -> bool:
        """Whether the middle of the box around the faces of a mechanism lies in it."""
        middle = mechanism.face_box().mean(axis=0)
        return bool(((self.bounds[0] <= middle) & (middle <= self.bounds[1])).all())


@dataclass(frozen=True, eq=False)
class Pin:
    """What stands in a region is of one type of mechanism."""

    type: str
    region: Region


@dataclass(frozen=True, eq=False)
class Wishes:
    """The user's hand; by default it rests.

    Attributes
    ----------
    kept:
        Mechanisms that stay as they are, each on the card or on a pair of an earlier one (its `pair` says which).
    forbidden:
        Types of mechanisms that may not be used, other than by those that are kept.
    keep_out:
        Regions that no face may reach into, likewise.
    pins:
        Regions in which only one type may stand, likewise.
    add:
        Whether anything is added to what is kept.
    """

    kept: tuple[Mechanism, ...] = ()
    forbidden: frozenset[str] = frozenset()
    keep_out: tuple[Region, ...] = ()
    pins: tuple[Pin, ...] = ()
    add: bool = True

    @property
    def placed(self) -> bool:
        """Whether they depend on how the model stands on the card."""
        return bool(self.kept or self.keep_out or self.pins)

    def allows(self, mechanism: Mechanism) -> bool:
        """Whether a mechanism that is not kept may be used."""
        if mechanism.type in self.forbidden or any(region.overlaps(mechanism) for region in self.keep_out):
            return False
        return all(pin.type == mechanism.type for pin in self.pins if pin.region.holds(mechanism))

    def scaled(self, factor: float) -> "Wishes":
        """The same wishes where all lengths are `factor` times as large; kept mechanisms do not change."""
        regions = tuple(Region(region.bounds * factor) for region in self.keep_out)
        pins = tuple(Pin(pin.type, Region(pin.region.bounds * factor)) for pin in self.pins)
        return replace(self, keep_out=regions, pins=pins)

    def unmet(self, mechanisms: tuple[Mechanism, ...]) -> tuple[str, ...]:
        """The pins in whose region nothing of their type stands, one sentence each."""
        return tuple(
            f"wish not met: nothing that could be a {pin.type} was found in its region {_words(pin.region)}"
            for pin in self.pins
            if not any(pin.type == m.type and pin.region.holds(m) for m in mechanisms)
        )


def _words(region: Region) -> str:
    return ", ".join(f"{axis} {low:g}..{high:g}" for axis, low, high in zip("xyz", *region.bounds, strict=True))

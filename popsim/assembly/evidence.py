"""What the execution of a step has shown, for the report."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from popsim import wording

DIGITS = 4
"""Decimals of lengths in the report, mm."""

PLAY = 0.3
"""mm; how far joints may open on the way, and how thick a flat stack of paper without thickness may be: what paper
gives."""

TOUCH = 0.05
"""mm by which parts may run through each other, beyond what joints open: as for the finished pop-up."""


@dataclass(frozen=True)
class Folded:
    """How a partial structure folded in a simulation of its own.

    Attributes
    ----------
    parts:
        Number of its parts.
    led:
        Number of hinges that hands led: one for each of its free motions.
    gap:
        How far any of its joints opened on the way, at most, mm.
    thickness:
        Greatest height of any part over the plane in which they lie in the end, mm.
    crossing:
        How deep two of its parts ran through each other on the way, at most, mm.
    crossed:
        Ids of these two; empty where none did.
    """

    parts: int
    led: int
    gap: float
    thickness: float
    crossing: float
    crossed: tuple[str, ...] = ()

    @property
    def refusal(self) -> str | None:
        """Why it does not fold flat; None where it does."""
        if self.gap > PLAY:
            return wording.OPENS.format(gap=self.gap)
        if self.thickness > PLAY:
            return wording.STANDS_UP.format(thickness=self.thickness)
        if self.crossing > TOUCH + self.gap:
            one, other = self.crossed
            return wording.CROSSES.format(
                through=wording.THROUGH.format(one=one, other=other), depth=self.crossing
            )
        return None


@dataclass(frozen=True)
class Evidence:
    """How a step was executed in simulation.

    Attributes
    ----------
    way:
        How the joints come together and are pressed, in words; why they cannot, where `feasible` is false.
    feasible:
        Whether a way was found.
    lying:
        Whether they are pressed lying flat; else they are made standing up.
    blind:
        Ids of the joints of which neither glue area is seen while they come together.
    samples:
        Number of poses at which the motion was searched for collisions; none was found.
    degrees:
        Fold angle at which things are held open for it; None where they lie flat.
    folded:
        How what hangs together afterwards folded on its own; None where no way was found.
    """

    way: str
    feasible: bool
    lying: bool = False
    blind: tuple[str, ...] = ()
    samples: int = 0
    degrees: float | None = None
    folded: Folded | None = None

    def to_dict(self) -> Mapping[str, Any]:
        """Plain data."""
        told: dict[str, Any] = {"feasible": self.feasible, "way": self.way}
        if self.folded is None:
            return told
        return told | {
            "lying": self.lying,
            "blind": list(self.blind),
            "poses_without_collision": self.samples,
            "held_at_degrees": self.degrees,
            "parts_together": self.folded.parts,
            "hinges_led_by_hand": self.folded.led,
            "loop_gap_mm": round(self.folded.gap, DIGITS),
            "folded_thickness_mm": round(self.folded.thickness, DIGITS),
            "crossing_mm": round(self.folded.crossing, DIGITS),
        }

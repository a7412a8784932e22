"""What the execution of a step has shown, for the report."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from popsim.assembly.reference import Reference

DIGITS = 4
"""Decimals of lengths in the report, mm."""

FOLDS_FLAT = "along the motion simulated with all joints: it keeps those made so far; a hand leads loose parts"
"""What a report means by folding flat in the middle of the assembly."""


@dataclass(frozen=True)
class Folded:
    """How the partial structure folds flat along the recorded motion of the finished pop-up.

    It has fewer joints than that, so the motion that was integrated with all of them keeps those it has; how well
    is measured. A run of its own could show no more: what hangs loose in it moves as a hand leads it.

    Attributes
    ----------
    parts:
        Number of its parts.
    gap:
        How far any of its joints opens on the way, at most, mm.
    thickness:
        Greatest distance between the planes in which its parts lie in the end, mm.
    """

    parts: int
    gap: float
    thickness: float

    @staticmethod
    def along(reference: Reference, parts: Iterable[str], joints: Iterable[str]) -> "Folded":
        """What hangs together by some joints, folded."""
        names = list(parts)
        low, high = zip(*(reference.closed_heights[name] for name in names), strict=True)
        gap = max((reference.gaps[name] for name in joints), default=0.0)
        return Folded(len(names), gap, max(high) - min(low))


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
        How what hangs together afterwards folds flat; None where no way was found.
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
            "loop_gap_mm": round(self.folded.gap, DIGITS),
            "folded_thickness_mm": round(self.folded.thickness, DIGITS),
        }

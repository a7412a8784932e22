"""How easy a plan is: what there is to do, and how long it takes somebody who does it for the first time."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from popsim import wording
from popsim.assembly.step import Step
from popsim.geometry.plane import path_length
from popsim.layout import Layout
from popsim.mechanisms.effort import PER_CREASE, PER_JOINT, PER_METRE

PER_STEP = 0.5
"""Minutes to read a step and to take things up for it."""

STANDING = 1.0
"""Minutes more for a joint that is held between two fingers until it sets."""

BLIND = 1.0
"""Minutes more for a joint that is not seen while it comes together."""


@dataclass(frozen=True)
class Ease:
    """What a plan asks of its maker.

    Attributes
    ----------
    steps, joints:
        How many there are.
    standing:
        Joints that are made standing up, pressed between two fingers.
    blind:
        Joints that are not seen while they come together.
    unproved:
        Joints for which no way was found.
    turns:
        How often what is in hand is turned over between two steps.
    apart:
        Pairs of joints that mirror each other but are not made in one step nor in neighbouring ones.
    minutes:
        For cutting, creasing and gluing.
    """

    steps: int
    joints: int
    standing: int
    blind: int
    unproved: int
    turns: int
    apart: int
    minutes: float

    def to_dict(self) -> Mapping[str, Any]:
        """Plain data."""
        return {
            "steps": self.steps,
            "joints": self.joints,
            "standing": self.standing,
            "blind": self.blind,
            "unproved": self.unproved,
            "turns": self.turns,
            "mirrored_apart": self.apart,
            "minutes": round(self.minutes, 1),
        }

    def __str__(self) -> str:
        """One line."""
        return wording.EASE.format(**vars(self))


def ease_of(layout: Layout, steps: Iterable[Step], *, turns: int, apart: int) -> Ease:
    """The ease of the steps of a layout, with the turns of what is in hand and the mirrored joints apart."""
    listed = list(steps)
    glued = [(step, step.evidence) for step in listed if step.evidence is not None]
    joints = sum(len(step.joints) for step, _ in glued)
    standing = sum(len(step.joints) for step, found in glued if found.feasible and not found.lying)
    blind = sum(len(found.blind) for _, found in glued)
    unproved = sum(len(step.joints) for step, found in glued if not found.feasible)
    cut = sum(piece.outline.length + sum(map(path_length, piece.slits)) for piece in layout.pieces) / 1000
    creases = sum(len(piece.folds) for piece in layout.pieces)
    minutes = PER_METRE * cut + PER_CREASE * creases + PER_STEP * len(listed) + PER_JOINT * joints
    minutes += STANDING * (standing + unproved) + BLIND * blind
    return Ease(len(listed), joints, standing, blind, unproved, turns, apart, minutes)

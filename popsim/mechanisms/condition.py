"""One geometric condition and how far it is from being broken."""

from dataclasses import dataclass
from typing import Literal

Aspect = Literal["foldable", "stable", "clear", "contained"]

IDENTITY = 1e-3
"""mm; an identity between lengths holds within this: a thousandth of the paper's own thickness, and the accuracy
that the simulation is asked for."""


@dataclass(frozen=True)
class Condition:
    """A condition on a design.

    Attributes
    ----------
    aspect:
        Which of the four it belongs to.
    subject:
        Id of the mechanism (or of the two, with a comma) it speaks of.
    name:
        The condition in words or as a formula.
    margin:
        mm to the limit; negative where the condition is broken.
    """

    aspect: Aspect
    subject: str
    name: str
    margin: float

    @property
    def holds(self) -> bool:
        """Whether the condition is met."""
        return self.margin >= 0


def identity(aspect: Aspect, subject: str, name: str, difference: float) -> Condition:
    """The condition that two lengths are equal, `difference` being what is measured between them, mm."""
    return Condition(aspect, subject, name, IDENTITY - abs(difference))

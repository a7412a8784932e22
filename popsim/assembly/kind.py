"""Kinds of steps."""

from enum import Enum


class StepKind(Enum):
    """What is done in a step."""

    CUT = "cut"
    """Everything is cut out and scored."""

    LAY = "lay"
    """A free piece, or what was glued before, comes to its place on something else."""

    FOLD = "fold"
    """Two sides of what is in hand are folded onto each other and glued."""

    FINISH = "finish"
    """The card is closed for the first time."""

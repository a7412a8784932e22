"""How the plates are integrated. None of these numbers is a tolerance: gaps are measured from the poses."""

from dataclasses import dataclass

TIMESTEP = 1e-3
"""s. With STIFFNESS and DAMPING below it corrects a loop error to first order within one step: the reference
acceleration is -k r - b v, and k dt^2 = b dt = 1."""

LOOP_SOLREF = "-1e6 -1e3"
"""Direct stiffness and damping of loops and crease limits, 1/s^2 and 1/s; independent of masses."""

ITERATIONS = 10
"""Most Newton iterations in a step. Loops that can close take one, and up to four where creases reach limits;
plates that are flung about by loops that cannot would take hundreds, and no pose of theirs counts."""

PRELOAD = 0.1
"""Torque that sends a flat crease to its own side, over the inertia of the patch, rad/s^2 per rad from closed. So
small that it displaces a card held open at 180 degrees by a ten thousandth of a millimetre."""


@dataclass(frozen=True)
class Pacing:
    """How slowly the pages are driven.

    Attributes
    ----------
    steps:
        Steps per degree.
    end_steps:
        Steps per degree within END_DEGREES of the fully open and the closed card, where poses are singular.
    settle:
        Steps at each stop with the pages held and velocities set to zero.
    end_settle:
        The same, within END_DEGREES of either end.
    damping:
        Joint damping over the inertia of the patch, 1/s.
    impedance:
        How much of the reference acceleration is enforced, below 1.
    """

    steps: int
    end_steps: int
    settle: int
    end_settle: int
    damping: float
    impedance: float


END_DEGREES = 3.0
"""Within this of 180 and 0 degrees the pages are driven by `end_steps`."""

BRISK = Pacing(steps=1, end_steps=5, settle=2, end_settle=3, damping=0.1, impedance=0.9999)
"""For designs whose loops can close; those that fold do so to below 0.0001 mm."""

STEADY = Pacing(steps=2, end_steps=10, settle=2, end_settle=6, damping=1.0, impedance=0.9999)
"""For designs that BRISK flings about although their loops can close: it tears one in thousands, where the closed
card begins to open."""

PATIENT = Pacing(steps=2, end_steps=20, settle=4, end_settle=10, damping=500.0, impedance=0.99)
"""For designs in which a gap is left: damped, so that loops that cannot close reach the best compromise instead of
flinging the plates about."""

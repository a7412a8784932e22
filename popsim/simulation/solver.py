"""How the plates are integrated. None of these numbers is a tolerance: gaps are measured from the poses."""

from dataclasses import dataclass

import numpy as np

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
    stops, end_stops:
        Degrees; at most this far apart the pages stop and the structure settles, whatever is recorded; the second
        within END_DEGREES of the fully open and the closed card, where poses are singular.
    steps, end_steps:
        Steps per degree, in the same order.
    settle:
        Steps at each stop with the pages held and velocities set to zero.
    end_settle:
        The same, within END_DEGREES of either end.
    damping:
        Joint damping over the inertia of the patch, 1/s.
    impedance:
        How much of the reference acceleration is enforced, below 1.
    hopeless:
        Loop gap at a stop, over the size of the pop-up, at which the sweep is broken off.
    """

    stops: float
    end_stops: float
    steps: float
    end_steps: float
    settle: int
    end_settle: int
    damping: float
    impedance: float
    hopeless: float = np.inf


END_DEGREES = 3.0
"""Within this of 180 and 0 degrees the pages are driven by `end_steps`."""

SWIFT = Pacing(
    stops=4,
    end_stops=1,
    steps=0.25,
    end_steps=5,
    settle=2,
    end_settle=3,
    damping=0.1,
    impedance=0.9999,
    hopeless=1e-3,
)
"""For what is sound, where few angles are recorded: strides of 4 degrees leave gaps of some 0.0001 mm at the
stops, and these are closed afterwards. Only a sweep without any fault counts; a design that cannot close its loops
is left to the others as soon as that shows."""

BRISK = Pacing(stops=2, end_stops=1, steps=1, end_steps=5, settle=2, end_settle=3, damping=0.1, impedance=0.9999)
"""For designs whose loops can close; those that fold do so to below 0.0001 mm."""

STEADY = Pacing(stops=2, end_stops=1, steps=2, end_steps=10, settle=2, end_settle=6, damping=1.0, impedance=0.9999)
"""For designs that BRISK flings about although their loops can close: it tears one in thousands, where the closed
card begins to open."""

PATIENT = Pacing(
    stops=2, end_stops=1, steps=2, end_steps=20, settle=4, end_settle=10, damping=500.0, impedance=0.99
)
"""For designs in which a gap is left: damped, so that loops that cannot close reach the best compromise instead of
flinging the plates about."""

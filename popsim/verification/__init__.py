"""The verdict on a design: what the theory states, what the simulation measures, and where they disagree.

Four aspects (Sec. 3.3): *foldable* - every loop closes at every angle, the closed card is flat, and it opens to
where it was; *stable* - nothing moves while the pages are held; *clear* - no patches cross; *contained* - nothing
sticks out of the closed card. Each carries the analytic margin, the measured values with their tolerances, and
both verdicts.

**Who decides.** The simulation. A design passes if the simulation finds all four aspects in order and agrees with
the closed forms. Where the theory passes an aspect and the simulation refuses it, that is a *hole*: always an
error (but what the theory says of the other aspects builds on mechanisms that fold). Where the theory refuses and
the simulation passes, that is *slack*: the conditions are only sufficient, so the design passes and the report
says so. Without mechanisms there is no theory, and the simulation alone decides.

**What is not judged.** Where loops do not close, poses mean nothing, and nothing else is judged. Where something
moves freely, where it ends up is chance: only loops and stability are judged. Either way the design is refused.
"""

from popsim.verification.settings import Settings
from popsim.verification.verdict import Finding, Measure, Verdict
from popsim.verification.verify import verify

__all__ = ["Finding", "Measure", "Settings", "Verdict", "verify"]

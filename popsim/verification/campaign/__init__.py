"""Campaigns: many random designs, theory and simulation side by side.

Half of the designs are valid by construction and half have exactly one condition broken. Each is examined and
verified, and counted in one confusion matrix per aspect. What is not as it must be is a *disagreement*:

- *hole*: the theory passes an aspect that the simulation refuses, or poses differ from their closed forms;
- *slack*: the theory refuses an aspect that the simulation passes. The conditions are only sufficient, so this is
  told, and no error;
- *surprise*: a design was not what it was made to be: a valid one was refused, or a broken one not, or not for
  the aspect that was broken;
- *crash*: verification raised an error.
"""

from popsim.verification.campaign.campaign import Campaign, Residual
from popsim.verification.campaign.plan import Task, plan
from popsim.verification.campaign.run import run_campaign
from popsim.verification.campaign.summary import summary
from popsim.verification.campaign.trial import Disagreement, Outcome, try_task

__all__ = [
    "Campaign",
    "Disagreement",
    "Outcome",
    "Residual",
    "Task",
    "plan",
    "run_campaign",
    "summary",
    "try_task",
]

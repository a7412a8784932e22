"""The second run, on paper that weighs, springs and is thick."""

from popsim.mechanisms.condition import Aspect
from popsim.simulation.physical import PaperRun, fold_paper
from popsim.stock import Stock
from popsim.verification.evidence import Evidence
from popsim.verification.judge import judge
from popsim.verification.settings import Settings

DETERMINED: Aspect = "clear"
"""An aspect that is judged only where loops close and nothing moves freely: there, forces have a meaning too."""


def run_on_paper(evidence: Evidence, settings: Settings, stock: Stock) -> tuple[PaperRun | None, str]:
    """What the folded design does when made of `stock`, or None and why that cannot be told.

    It takes the poses of the rigid run as they are, and no part in the verdict.
    """
    _, unjudged = judge(evidence, settings, DETERMINED)
    return (None, unjudged) if unjudged else (fold_paper(evidence.rig, evidence.sweep, stock), "")

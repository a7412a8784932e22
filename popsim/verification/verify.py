"""Both verdicts on a design."""

from popsim.design import Design
from popsim.mechanisms import Condition
from popsim.mechanisms.condition import Aspect
from popsim.simulation.physical import PaperRun
from popsim.stock import Stock
from popsim.validity import Theory, examine
from popsim.verification.agreement import agreement, measured_ranges
from popsim.verification.evidence import Evidence, gather
from popsim.verification.judge import grade, judge, rigid_and_steady
from popsim.verification.paper import run_on_paper
from popsim.verification.paper_report import paper_notes
from popsim.verification.play import Play, play_needed
from popsim.verification.settings import Settings
from popsim.verification.verdict import Finding, Verdict

ASPECTS: tuple[Aspect, ...] = ("foldable", "stable", "clear", "contained")
"""In the order in which they are told."""

DEFAULT = Settings()

MOST_TOLD = 3
"""Broken conditions that a note lists."""

UNSURE_ENDS = "its loops need play, so torque near the open and the closed card depends on what gives way there"


def verify(
    design: Design, settings: Settings = DEFAULT, stock: Stock | None = None, *, beside: tuple[str, ...] = ()
) -> Verdict:
    """Fold `design`, state its theory, and compare.

    The design is trusted as :func:`popsim.design.parse_design` checks it; of its mechanisms only patches count.
    With a `stock` it is folded again as paper, which changes nothing of the verdict. Sentences `beside` join its
    notes: what the caller knows of the files of the design.
    """
    theory = examine(design)
    evidence = gather(design, settings)
    findings = tuple(_finding(aspect, theory, evidence, settings) for aspect in ASPECTS)
    play = play_needed(design, evidence, settings)
    paper, untold = (None, "") if stock is None else run_on_paper(evidence, settings, stock)
    comparable = findings[0].theory is True and rigid_and_steady(evidence, settings)
    compared, left_out = agreement(evidence, theory, settings) if comparable else ((), "")
    return Verdict(
        findings=findings,
        agreement=compared,
        grade=grade(evidence, settings),
        ranges=measured_ranges(evidence.sweep, theory) if comparable else {},
        notes=(
            *_notes(design, evidence, play, settings),
            *filter(None, [left_out]),
            *map(_slack_note, (finding for finding in findings if finding.disagreement == "slack")),
            *_paper_notes(paper, untold, play),
            *beside,
        ),
        evidence=evidence,
        play=play,
        paper=paper,
    )


def _finding(aspect: Aspect, theory: Theory, evidence: Evidence, settings: Settings) -> Finding:
    conditions: tuple[Condition, ...] | None = None
    if theory.design.mechanisms:
        conditions = tuple(condition for condition in theory.conditions if condition.aspect == aspect)
    measures, unjudged = judge(evidence, settings, aspect)
    folds = all(condition.holds for condition in theory.conditions if condition.aspect == "foldable")
    return Finding(aspect, conditions, measures, unjudged, founded=aspect == "foldable" or folds)


def _notes(design: Design, evidence: Evidence, play: Play | None, settings: Settings) -> tuple[str, ...]:
    notes = []
    if not design.mechanisms:
        notes.append(
            "the design names no mechanisms: there is no theory to compare with, the simulation alone decides"
        )
    if play is not None and (play.shortened is not None or grade(evidence, settings) == "within play"):
        notes.append(play.sentence)
    return tuple(notes)


def _slack_note(finding: Finding) -> str:
    """What the theory refuses and the simulation passes, in words: the margin of a wrong shape says nothing."""
    broken = [condition for condition in finding.conditions or () if not condition.holds]
    told = "; ".join(f"{condition.subject}: {condition.name}" for condition in broken[:MOST_TOLD])
    more = f"; and {len(broken) - MOST_TOLD} more" if len(broken) > MOST_TOLD else ""
    return f"slack: the theory refuses that it is {finding.aspect} ({told}{more}), the simulation does not"


def _paper_notes(paper: PaperRun | None, untold: str, play: Play | None) -> list[str]:
    if paper is None:
        return [f"nothing can be told of it as paper: {untold}"] if untold else []
    return [*([] if play is None else [UNSURE_ENDS]), *paper_notes(paper)]

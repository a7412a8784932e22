"""Theory and simulation on one design of a campaign."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from popsim.design import dump_design
from popsim.mechanisms.condition import Aspect
from popsim.verification.campaign.plan import Task
from popsim.verification.random_designs import RandomDesign
from popsim.verification.settings import Settings
from popsim.verification.verdict import Finding, Verdict
from popsim.verification.verify import verify

Kind = Literal["hole", "slack", "surprise", "crash"]

BASIC: tuple[Aspect, ...] = ("foldable", "stable")
"""Aspects on which the others rest, in their order."""


@dataclass(frozen=True)
class Disagreement:
    """Something that is not as it must be (see :mod:`popsim.verification.campaign`).

    Attributes
    ----------
    kind:
        hole, slack, surprise or crash.
    subject:
        The aspect or the closed form it is about.
    text:
        What was found, in words.
    """

    kind: Kind
    subject: str
    text: str


@dataclass(frozen=True)
class Outcome:
    """What came of one task; plain data, so that it travels between processes.

    Attributes
    ----------
    task:
        Which design it was.
    note:
        How the design was made.
    patches, mechanisms:
        How many it has.
    verdicts:
        Theory and simulation by aspect; None where there is no verdict.
    measured:
        Values of all measures of valid designs, by name, in their units.
    reason:
        For a flaw: the measure by which the simulation refused the aspect that was broken.
    disagreements:
        All of them.
    design:
        Text of the design where there is any disagreement.
    """

    task: Task
    note: str = ""
    patches: int = 0
    mechanisms: int = 0
    verdicts: Mapping[Aspect, tuple[bool | None, bool | None]] = field(default_factory=dict)
    measured: Mapping[str, float] = field(default_factory=dict)
    reason: str = ""
    disagreements: tuple[Disagreement, ...] = ()
    design: str | None = None


def try_task(task: Task, settings: Settings) -> Outcome:
    """Draw the design of a task and compare theory, simulation and expectation."""
    try:
        drawn = task.draw()
    except Exception as error:
        return Outcome(task, disagreements=(_crash("drawing", error),))
    outcome = Outcome(task, drawn.note, len(drawn.design.patches), len(drawn.design.mechanisms))
    try:
        verdict = verify(drawn.design, settings)
    except Exception as error:
        return replace(outcome, disagreements=(_crash("verifying", error),), design=dump_design(drawn.design))
    found = tuple(_disagreements(verdict, drawn))
    return replace(
        outcome,
        verdicts={finding.aspect: (_theory(verdict, finding), finding.simulation) for finding in verdict.findings},
        measured=_measured(verdict) if drawn.expected is None else {},
        reason=_reason(verdict, drawn.expected),
        disagreements=found,
        design=dump_design(drawn.design) if found else None,
    )


def _theory(verdict: Verdict, finding: Finding) -> bool | None:
    """What the theory says of an aspect; None where it refuses one on which that rests.

    Where something does not fold, or moves freely, nobody knows where it goes: what the theory says of meeting
    and of sticking out holds for the pose it would have had.
    """
    order = [each.aspect for each in verdict.findings]
    rests_on = [aspect for aspect in BASIC if order.index(aspect) < order.index(finding.aspect)]
    return finding.theory if all(verdict.finding(aspect).theory for aspect in rests_on) else None


def _disagreements(verdict: Verdict, drawn: RandomDesign) -> Iterator[Disagreement]:
    for finding in verdict.findings:
        if finding.disagreement is not None and _theory(verdict, finding) is not None:
            yield Disagreement(finding.disagreement, finding.aspect, _told(finding))
    for measure in verdict.agreement:
        if not measure.holds:
            text = f"{measure.value:.3g} {measure.unit} is more than {measure.tolerance:g} {measure.where}".strip()
            yield Disagreement("hole", measure.name, text)
    for finding in verdict.findings:
        broken = finding.aspect == drawn.expected
        if finding.theory is broken:
            yield Disagreement("surprise", finding.aspect, f"{drawn.note}: the theory {_says(finding.theory)}")
        if broken and finding.simulation is None:
            yield Disagreement("surprise", finding.aspect, f"{drawn.note}: not judged, {finding.unjudged}")


def _told(finding: Finding) -> str:
    margin = "" if finding.tightest is None else f" (least margin {finding.tightest.margin:.3g} mm)"
    worst = finding.worst
    found = "" if worst is None else f": {worst.name} {worst.value:.3g} {worst.unit} {worst.where}".rstrip()
    return f"the theory {_says(finding.theory)}{margin}, the simulation {_says(finding.simulation)}{found}"


def _says(verdict: bool | None) -> str:
    return "passes it" if verdict else "refuses it"


def _measured(verdict: Verdict) -> dict[str, float]:
    measures = (*verdict.agreement, *(measure for finding in verdict.findings for measure in finding.measures))
    return {measure.name: float(measure.value) for measure in measures}


def _reason(verdict: Verdict, expected: str | None) -> str:
    for finding in verdict.findings:
        if finding.aspect == expected and finding.simulation is False and finding.worst is not None:
            return finding.worst.name
    return ""


def _crash(doing: str, error: Exception) -> Disagreement:
    return Disagreement("crash", doing, f"{type(error).__name__}: {error}")

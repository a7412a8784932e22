"""What verification says."""

from dataclasses import dataclass, field
from typing import Any, Literal

from popsim.mechanisms import Condition
from popsim.mechanisms.condition import Aspect
from popsim.simulation.physical import PaperRun
from popsim.verification.evidence import Evidence
from popsim.verification.play import Play

Grade = Literal["rigid", "within play", "refused"]
Disagreement = Literal["hole", "slack"]


@dataclass(frozen=True)
class Measure:
    """Something measured against its tolerance.

    Attributes
    ----------
    name:
        What.
    value, tolerance:
        In `unit`; the value must not exceed the tolerance.
    unit:
        "mm", or "" for a number.
    where:
        Patch, hinge, angle: whatever tells where to look.
    """

    name: str
    value: float
    tolerance: float
    unit: str = "mm"
    where: str = ""

    @property
    def holds(self) -> bool:
        """Whether the value is within the tolerance; what is no number is not."""
        return self.value <= self.tolerance

    @property
    def excess(self) -> float:
        """Value over tolerance; above 1 it is broken."""
        return self.value / self.tolerance if self.tolerance else self.value * float("inf") if self.value else 0.0

    @property
    def found(self) -> str:
        """The value with its unit, in words."""
        return f"{self.value:.3g} {self.unit}".strip()

    @property
    def allowed(self) -> str:
        """The tolerance with its unit, in words."""
        return f"{self.tolerance:.3g} {self.unit}".strip()


@dataclass(frozen=True)
class Finding:
    """Both verdicts on one aspect.

    Attributes
    ----------
    aspect:
        One of the four.
    conditions:
        What the theory states of it; None where there is no theory.
    measures:
        What the simulation found; empty where it could not be judged.
    unjudged:
        Why not, or "".
    founded:
        Whether the design has what the theory of this aspect builds on: mechanisms that fold.
    """

    aspect: Aspect
    conditions: tuple[Condition, ...] | None
    measures: tuple[Measure, ...]
    unjudged: str = ""
    founded: bool = True

    @property
    def theory(self) -> bool | None:
        """Verdict of the theory, None without one."""
        return None if self.conditions is None else all(condition.holds for condition in self.conditions)

    @property
    def simulation(self) -> bool | None:
        """Verdict of the simulation, None where it could not judge."""
        return None if self.unjudged else all(measure.holds for measure in self.measures)

    @property
    def disagreement(self) -> Disagreement | None:
        """A hole in the theory (or in the code), slack in its conditions, or None."""
        if self.theory is None or self.simulation is None or self.theory == self.simulation:
            return None
        if not self.theory:
            return "slack"
        return "hole" if self.founded else None

    @property
    def tightest(self) -> Condition | None:
        """The condition with the least margin."""
        return min(self.conditions or (), key=lambda condition: condition.margin, default=None)

    @property
    def worst(self) -> Measure | None:
        """The measure to show: the most broken one, or the first where none is."""
        broken = [measure for measure in self.measures if not measure.holds]
        return max(broken, key=lambda measure: measure.excess, default=next(iter(self.measures), None))


@dataclass(frozen=True, eq=False)
class Verdict:
    """The whole verdict.

    Attributes
    ----------
    findings:
        Of the four aspects.
    agreement:
        How well simulation and closed forms agree; empty where there is nothing to compare.
    grade:
        How much give the loops need.
    ranges:
        Measured and analytic closing range of each mechanism, mm, by its id; None where the theory has none.
    notes:
        Sentences for the reader.
    evidence:
        The motion and everything measured in it.
    play:
        Where and how much, and how to need less; None where it folds rigidly, or loops tear.
    paper:
        What a second run on paper has measured; it takes no part in the verdict. None where none was asked for, or
        nothing can be told: a note says why.
    """

    findings: tuple[Finding, ...]
    agreement: tuple[Measure, ...]
    grade: Grade
    ranges: dict[str, tuple[tuple[float, float], tuple[float, float] | None]]
    notes: tuple[str, ...]
    evidence: Evidence = field(repr=False)
    play: Play | None = None
    paper: PaperRun | None = field(default=None, repr=False)

    @property
    def passed(self) -> bool:
        """Whether the simulation finds everything in order, and theory and closed forms nothing else."""
        return all(finding.simulation for finding in self.findings) and not self.holes

    @property
    def holes(self) -> tuple[str, ...]:
        """Where the theory passes what the simulation does not find; always an error."""
        aspects = [finding.aspect for finding in self.findings if finding.disagreement == "hole"]
        return (*aspects, *(measure.name for measure in self.agreement if not measure.holds))

    @property
    def slack(self) -> tuple[str, ...]:
        """Aspects that the theory refuses and the simulation passes."""
        return tuple(finding.aspect for finding in self.findings if finding.disagreement == "slack")

    def finding(self, aspect: Aspect) -> Finding:
        """The finding of one aspect."""
        return next(finding for finding in self.findings if finding.aspect == aspect)

    def rows(self) -> list[dict[str, str]]:
        """One row of short texts per aspect, for a table."""
        from popsim.verification.report import rows

        return rows(self)

    def to_junit(self, name: str) -> str:
        """The verdict as JUnit XML, `name` being that of the design."""
        from popsim.verification.junit import to_junit

        return to_junit(self, name)

    def to_json(self) -> str:
        """The report; the same design gives the same text."""
        from popsim.verification.report import to_json

        return to_json(self)

    def to_dict(self) -> dict[str, Any]:
        """The report as plain data."""
        from popsim.verification.report import to_dict

        return to_dict(self)

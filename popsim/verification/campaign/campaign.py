"""The sum of a campaign."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from popsim import __version__
from popsim.mechanisms.condition import Aspect
from popsim.verification.campaign.trial import Disagreement, Outcome

Cell = tuple[bool | None, bool | None]
"""Verdicts of theory and simulation; None where there is none."""


@dataclass(frozen=True)
class Residual:
    """The largest value of a measure over all valid designs, and the number of the design that has it."""

    value: float
    index: int


@dataclass(frozen=True)
class Campaign:
    """What a campaign found.

    Attributes
    ----------
    seed:
        From which it was drawn.
    outcomes:
        Of each design, in order.
    """

    seed: int
    outcomes: tuple[Outcome, ...]

    @property
    def count(self) -> int:
        """Number of designs."""
        return len(self.outcomes)

    @cached_property
    def matrices(self) -> dict[Aspect, Counter[Cell]]:
        """Confusion matrix of each aspect: how often theory and simulation gave each pair of verdicts."""
        found: dict[Aspect, Counter[Cell]] = {}
        for outcome in self.outcomes:
            for aspect, cell in outcome.verdicts.items():
                found.setdefault(aspect, Counter())[cell] += 1
        return found

    @cached_property
    def residuals(self) -> dict[str, Residual]:
        """Largest value of each measure over the valid designs, by its name."""
        largest: dict[str, Residual] = {}
        for outcome in self.outcomes:
            for name, value in outcome.measured.items():
                if name not in largest or not value <= largest[name].value:
                    largest[name] = Residual(value, outcome.task.index)
        return largest

    @cached_property
    def refusals(self) -> dict[str, Counter[str]]:
        """For each flaw, how often which measure refused the aspect that was broken; "" where none did."""
        found: dict[str, Counter[str]] = {}
        for outcome in self.outcomes:
            if outcome.task.flaw is not None:
                found.setdefault(outcome.task.flaw, Counter())[outcome.reason] += 1
        return found

    @cached_property
    def disagreements(self) -> tuple[tuple[Outcome, Disagreement], ...]:
        """All disagreements with the design they are about."""
        return tuple((outcome, each) for outcome in self.outcomes for each in outcome.disagreements)

    @property
    def passed(self) -> bool:
        """Whether nothing but slack was found."""
        return all(each.kind == "slack" for _, each in self.disagreements)

    def to_dict(self) -> dict[str, Any]:
        """The report as plain data; the same campaign gives the same, on any number of jobs."""
        return {
            "popsim": __version__,
            "designs": self.count,
            "seed": self.seed,
            "patches": sum(outcome.patches for outcome in self.outcomes),
            "mechanisms": sum(outcome.mechanisms for outcome in self.outcomes),
            "passed": self.passed,
            "matrices": {aspect: _cells(matrix) for aspect, matrix in self.matrices.items()},
            "residuals": {
                name: {"value": residual.value, "design": residual.index}
                for name, residual in sorted(self.residuals.items())
            },
            "refusals": {flaw: dict(sorted(reasons.items())) for flaw, reasons in sorted(self.refusals.items())},
            "disagreements": [
                {"design": outcome.task.index, "file": file_name(outcome), "flaw": outcome.task.flaw, **vars(each)}
                for outcome, each in self.disagreements
            ],
        }


def file_name(outcome: Outcome) -> str | None:
    """Name of the file that holds the design of an outcome with disagreements."""
    if outcome.design is None:
        return None
    kinds = sorted({each.kind for each in outcome.disagreements})
    return f"design-{outcome.task.index:06d}-{'-'.join(kinds)}.json"


def _cells(matrix: Iterable[Cell] | Counter[Cell]) -> list[dict[str, Any]]:
    counted = Counter(matrix)
    order = sorted(counted, key=lambda cell: [str(verdict) for verdict in cell], reverse=True)
    return [{"theory": cell[0], "simulation": cell[1], "designs": counted[cell]} for cell in order]

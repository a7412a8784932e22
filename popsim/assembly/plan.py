"""The assembly plan: steps in a feasible order, as data and as text."""

from dataclasses import dataclass, replace
from itertools import groupby

from popsim.assembly.order import gluing_order
from popsim.assembly.precedence import Precedence
from popsim.assembly.wording import closing_text, cutting_text, gluing_text
from popsim.layout import Layout


@dataclass(frozen=True)
class Step:
    """One thing to do.

    Attributes
    ----------
    number:
        1, 2, 3 ...
    pieces:
        Names of the pieces in hand, those new in this step first.
    joints:
        Ids of the joints that are glued, in order; none in the first and last step.
    text:
        What to do, in English.
    """

    number: int
    pieces: tuple[str, ...]
    joints: tuple[str, ...]
    text: str


@dataclass(frozen=True, eq=False)
class AssemblyPlan:
    """Steps, and the layout with its glue joints numbered in the order of gluing.

    Attributes
    ----------
    steps:
        In order.
    order:
        Ids of all glue joints in the order of gluing.
    before:
        Pairs of joint ids (first, second): the second must wait for the first.
    layout:
        The layout that was planned, renumbered; draw and export this one.
    """

    steps: tuple[Step, ...]
    order: tuple[str, ...]
    before: tuple[tuple[str, str], ...]
    layout: Layout

    @property
    def text(self) -> str:
        """All steps as Markdown."""
        lines = ["# Assembly", ""]
        lines += [f"{step.number}. {step.text}" for step in self.steps]
        return "\n".join(lines) + "\n"


def plan_assembly(layout: Layout) -> AssemblyPlan:
    """Plan how to put a layout together; see :mod:`popsim.assembly.precedence` for what decides the order."""
    precedence = Precedence(layout)
    order = gluing_order(precedence)
    numbered = replace(layout, numbers={name: k for k, name in enumerate(order, 1)})
    steps = [Step(1, tuple(piece.name for piece in layout.pieces), (), cutting_text(numbered))]
    handled: set[str] = set()
    for ends, names in groupby(order, key=lambda name: frozenset(precedence.ends[name])):
        joints = tuple(names)
        new = [piece.name for piece in layout.pieces if piece.name in ends and piece.name not in handled]
        pieces = (*new, *(piece.name for piece in layout.pieces if piece.name in ends & handled))
        handled |= ends
        steps.append(Step(len(steps) + 1, pieces, joints, gluing_text(numbered, new, joints)))
    steps.append(Step(len(steps) + 1, (), (), closing_text()))
    before = tuple(sorted(precedence.graph.edges))
    return AssemblyPlan(tuple(steps), order, before, numbered)

"""The assembly plan: steps in a feasible order, as data and as text."""

from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from popsim.assembly.flap_motion import flap_motions
from popsim.assembly.order import gluing_order
from popsim.assembly.precedence import Precedence
from popsim.assembly.scene import Scene, flap_key
from popsim.assembly.step import Step, StepKind
from popsim.assembly.wording import closing_text, cutting_text, gluing_text
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.layout import Layout


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
    steps = [Step(1, StepKind.CUT, tuple(piece.name for piece in layout.pieces), (), cutting_text(numbered))]
    handled: set[str] = set()
    for ends, names in groupby(order, key=lambda name: frozenset(precedence.ends[name])):
        joints = tuple(names)
        new = [piece.name for piece in layout.pieces if piece.name in ends and piece.name not in handled]
        pieces = (*new, *(piece.name for piece in layout.pieces if piece.name in ends & handled))
        before = _standing(layout, handled)
        handled |= ends
        steps.append(
            Step(
                number=len(steps) + 1,
                kind=StepKind.LAY if new else StepKind.FOLD,
                pieces=pieces,
                joints=joints,
                text=gluing_text(numbered, new, joints),
                parts=tuple(part for part, piece in layout.piece_of.items() if piece.name in new),
                flaps=tuple(flap_key(flap) for flap in layout.flaps if flap.joint.id in joints),
                before=before,
                after=_standing(layout, handled),
            )
        )
    steps.append(Step(len(steps) + 1, StepKind.FINISH, (), (), closing_text(), before=_standing(layout, handled)))
    waits = tuple(sorted(precedence.graph.edges))
    return AssemblyPlan(tuple(steps), order, waits, numbered)


def _standing(layout: Layout, pieces: set[str]) -> Scene:
    """Pieces as they stand in the finished pop-up."""
    parts = {part for part, piece in layout.piece_of.items() if piece.name in pieces}
    poses = {name: np.eye(4) for name in layout.parts if name in parts}
    flaps = {
        key: motion.turned(motion.glued)
        for key, motion in flap_motions(layout).items()
        if motion.flap.carrier in parts
    }
    return Scene(poses, flaps, np.pi if parts & {GROUND_ID, BACKDROP_ID} else None)

"""The assembly plan: steps in an order that was executed, as data and as text."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Any

from popsim import wording
from popsim.assembly.at_once import glued_together
from popsim.assembly.ease import Ease, ease_of
from popsim.assembly.evidence import Evidence, Folded
from popsim.assembly.faces import turns
from popsim.assembly.folding import Folding
from popsim.assembly.kind import StepKind
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof
from popsim.assembly.scene import flap_key
from popsim.assembly.step import Step
from popsim.assembly.storyboard import finished, scenes
from popsim.assembly.telling import cutting_text, gluing_text, unproved_text
from popsim.assembly.twins import apart
from popsim.assembly.unmaking import Order, find_order
from popsim.assembly.way import Way
from popsim.beside import begun
from popsim.layout import Layout, Piece
from popsim.simulation import Sweep


@dataclass(frozen=True, eq=False)
class AssemblyPlan:
    """Steps, and the layout with its glue joints numbered in the order of gluing.

    Attributes
    ----------
    steps:
        In order.
    order:
        Ids of all glue joints in the order of gluing.
    layout:
        The layout that was planned, renumbered; draw and export this one.
    ease:
        How much there is to do.
    """

    steps: tuple[Step, ...]
    order: tuple[str, ...]
    layout: Layout
    ease: Ease

    @property
    def text(self) -> str:
        """All steps as Markdown."""
        lines = [f"# {wording.ASSEMBLY}", "", wording.FOLD_FIRST, ""]
        lines += [f"{step.number}. {step.text}" for step in self.steps]
        return "\n".join(lines) + "\n"

    @property
    def unproved(self) -> tuple[Step, ...]:
        """Steps for which no way was found; none where the order is feasible."""
        return tuple(step for step in self.steps if step.evidence is not None and not step.evidence.feasible)


def plan_assembly(layout: Layout, sweep: Sweep) -> AssemblyPlan:
    """Plan how to put a layout together, executing every step.

    Parameters
    ----------
    layout:
        What is put together.
    sweep:
        The recorded motion of its design, as :func:`popsim.simulation.fold_design` gives it.

    Returns
    -------
    The plan. Joints for which no way was found come last; their steps carry evidence that says why. So do steps
    after which what is glued does not fold flat in a simulation of its own.
    """
    kit = Kit(layout, sweep)
    found = find_order(kit)
    proofs = glued_together(found.proofs)
    order = tuple(name for proof in proofs for name in proof.joints) + found.left
    numbered = replace(layout, numbers={name: k for k, name in enumerate(order, 1)})
    steps = _Steps(kit, numbered)
    steps.add(StepKind.CUT, (), cutting_text(numbered), pieces=tuple(piece.name for piece in layout.pieces))
    folding = Folding(kit)
    folded = begun(lambda proof: folding.folded(proof) if proof.joints else None, proofs)
    for proof, result in zip(proofs, folded(), strict=True):
        steps.prove(proof, result)
    for name in found.left:
        steps.doubt(name, found)
    steps.add(StepKind.FINISH, (), wording.CLOSING, before=finished(kit))
    mirrored = apart(kit.twins, (proof.joints for proof in proofs if proof.joints))
    ease = ease_of(layout, steps.made, turns=turns(kit, proofs), apart=mirrored)
    return AssemblyPlan(tuple(steps.made), order, numbered, ease)


class _Steps:
    """The steps so far."""

    def __init__(self, kit: Kit, numbered: Layout) -> None:
        self.made: list[Step] = []
        self._kit, self._numbered = kit, numbered
        self._pieces: set[str] = set()
        self._joints: frozenset[str] = frozenset()
        self._folded: list[Piece] = []

    def prove(self, proof: Proof, folded: Folded | None) -> None:
        """Add a step that was executed, and after which what is glued folded as `folded` says.

        What is only folded over (None) is told with the next step that shows it.
        """
        layout = self._kit.layout
        if folded is None:
            self._folded += [piece for piece in layout.pieces if not proof.movers.isdisjoint(piece.motions)]
            return
        before, after, moved = scenes(self._kit, proof, self._joints)
        refusal = folded.refusal
        evidence = Evidence(
            refusal or proof.way.value,
            refusal is None,
            proof.way.lying,
            proof.blind,
            max(len(poses) for poses in proof.motion.values()),
            proof.degrees,
            folded,
        )
        kind = StepKind.LAY if proof.way in (Way.LAID, Way.SLID) else StepKind.FOLD
        flat = self._folded_before(before.poses)
        if proof.degrees is not None:
            flat = []  # all is opened for it, what was folded over too
        text = (
            gluing_text(self._numbered, proof.joints, proof.way, flat)
            if refusal is None
            else unproved_text(self._numbered, proof.joints, refusal, flat)
        )
        self._glue(kind, proof.joints, text, evidence=evidence, before=before, after=after, motion=moved)

    def doubt(self, name: str, order: Order) -> None:
        """Add a joint for which no way was found."""
        whole = finished(self._kit)
        reason = order.refusals.get(name, wording.NOT_REACHED)
        text = unproved_text(self._numbered, (name,), reason, self._folded_before(whole.poses))
        self._glue(StepKind.LAY, (name,), text, evidence=Evidence(reason, False), before=whole, after=whole)

    def add(self, kind: StepKind, joints: tuple[str, ...], text: str, **more: Any) -> None:
        """Add a step."""
        self.made.append(Step(len(self.made) + 1, kind, joints=joints, text=text, **({"pieces": ()} | more)))

    def _glue(self, kind: StepKind, joints: tuple[str, ...], text: str, **more: Any) -> None:
        layout = self._kit.layout
        flaps = [flap for name in joints for flap in self._kit.flaps_of[name]]
        touched = {layout.piece_of[part].name for flap in flaps for part in (flap.carrier, flap.target)}
        new = [piece.name for piece in layout.pieces if piece.name in touched - self._pieces]
        old = [piece.name for piece in layout.pieces if piece.name in touched & self._pieces]
        self._pieces |= touched
        self._joints |= set(joints)
        self.add(
            kind,
            joints,
            text,
            pieces=(*new, *old),
            parts=tuple(part for part, piece in layout.piece_of.items() if piece.name in new),
            flaps=tuple(flap_key(flap) for flap in flaps),
            **more,
        )

    def _folded_before(self, shown: Collection[str]) -> list[str]:
        """Names of the pieces that were folded over of the parts that a step shows; they are not told again."""
        here = [piece for piece in self._folded if not piece.motions.keys().isdisjoint(shown)]
        self._folded = [piece for piece in self._folded if piece not in here]
        return list(dict.fromkeys(piece.name for piece in here))

"""What is folded: rigid parts, and the joints that were made."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from popsim.design import Design
from popsim.simulation.turning import Turn, free_turns


@dataclass(frozen=True, eq=False)
class Structure:
    """Parts that hang together.

    Attributes
    ----------
    design:
        The parts as patches, and the joints as hinges; pages may be missing, and the card's fold is one of them.
    seams:
        Ids of the hinges that never turn: between two parts of one patch.
    turns:
        How far each other hinge turns before paper is in the way, by its id.
    root:
        The part that keeps still.
    """

    design: Design
    seams: frozenset[str]
    turns: Mapping[str, Turn]
    root: str

    @staticmethod
    def of(design: Design, seams: frozenset[str], root: str) -> "Structure":
        """All of a design."""
        turning = [hinge for hinge in design.hinges if hinge.id not in seams]
        return Structure(design, seams, free_turns(design, turning), root)

    def only(self, parts: Collection[str], hinges: Collection[str], root: str) -> "Structure":
        """Some of its parts, with some of the hinges between them."""
        whole = self.design
        kept = Design(
            card=whole.card,
            patches=tuple(patch for patch in whole.patches if patch.id in parts),
            hinges=tuple(hinge for hinge in whole.hinges if hinge.id in hinges),
        )
        turns = {hinge.id: self.turns[hinge.id] for hinge in kept.hinges if hinge.id in self.turns}
        return replace(self, design=kept, turns=turns, root=root)

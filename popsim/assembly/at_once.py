"""Joints that are glued at once."""

from collections.abc import Iterable
from dataclasses import replace

from popsim.assembly.proof import Proof
from popsim.assembly.way import Way

AT_ONCE = 6
"""Joints that are glued by one motion at most: glue dries."""


OPEN_AT_ONCE = 3
"""The same where all is held open meanwhile: so many flaps are found with the glue on them."""


def glued_together(proofs: Iterable[Proof]) -> tuple[Proof, ...]:
    """Steps in their order, with those that are alike and follow each other made one.

    Glue that is put onto the same parts, opened as far, is pressed by the same folding: whether it gets there does
    not depend on what else is glued, and the parts move as they did step by step.
    """
    found: list[Proof] = []
    for proof in proofs:
        last = found[-1] if found else None
        if last is not None and _alike(last, proof):
            found[-1] = replace(last, joints=last.joints + proof.joints, blind=last.blind + proof.blind)
        else:
            found.append(proof)
    return tuple(found)


def _alike(one: Proof, other: Proof) -> bool:
    opened = (one.way, one.degrees, set(one.motion)) == (other.way, other.degrees, set(other.motion))
    return opened and one.way is Way.CLOSED and len(one.joints) + len(other.joints) <= OPEN_AT_ONCE

"""What planning the assembly costs and what it saves: against orders drawn at random of all that can be done."""

import time
from itertools import chain
from random import Random

from conftest import Report

from popsim.assembly.bundle import Bundle
from popsim.assembly.holding import Holding
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial
from popsim.assembly.unmaking import find_order
from popsim.layout import lay_out
from popsim.simulation import fold_design
from popsim.verification.random_designs import random_design

DESIGNS = 12


def at_random(kit: Kit, rng: Random) -> tuple[Proof, ...]:
    """Joints undone one by one, whichever can be undone; backwards an order that waits where it must."""
    stack, waiting, found = Stack(kit), [Bundle.whole(kit)], list[Proof]()
    while waiting:
        bundle = waiting.pop()
        names = list(bundle.glued)
        rng.shuffle(names)
        proof = next((one for name in names if (one := _undone(bundle, stack, name, len(found)))), None)
        if proof is not None:
            found.append(proof)
            waiting += proof.apart
    return tuple(found)


def _undone(bundle: Bundle, stack: Stack, name: str, number: int) -> Proof | None:
    trial, holding = Trial(bundle, stack, number), Holding(bundle.folded, name)
    lying = (trial.cut(cut) for cut in trial.cuts if cut.taken == (name,))
    held = (way() for way in (holding.closed, holding.pressed, holding.brought))
    return next((result for result in chain(lying, held) if isinstance(result, Proof)), None)


def test_planned_and_random_orders(report: Report) -> None:
    rows = []
    for seed in range(DESIGNS):
        design = random_design(seed, mechanisms=(1, 8)).design
        kit = Kit(lay_out(design), fold_design(design, 90).sweep)
        start = time.process_time()
        planned = find_order(kit)
        seconds = time.process_time() - start
        drawn = at_random(kit, Random(seed))
        rows.append((len(kit.layout.parts), seconds, *_counts(kit, planned.proofs), *_counts(kit, drawn)))
    means = [sum(row[k] for row in rows) / len(rows) for k in range(len(rows[0]))]
    heads = ("parts", "s", "steps", "standing", "blind", "left", "steps, random", "standing", "blind", "left")
    report(f"assembly of {DESIGNS} random designs, the last row their mean", heads, [*rows, means])
    assert means[3] + means[5] <= means[7] + means[9]


def _counts(kit: Kit, proofs: tuple[Proof, ...]) -> tuple[int, int, int, int]:
    glued = [proof for proof in proofs if proof.joints]
    standing = sum(len(proof.joints) for proof in glued if not proof.way.lying)
    blind = sum(len(proof.blind) for proof in glued)
    return len(glued), standing, blind, len(kit.flaps_of) - sum(len(proof.joints) for proof in glued)

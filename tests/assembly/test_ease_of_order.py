"""What makes an order easy: the same twice in a row, and few turns of what is in hand."""

from functools import cache

from popsim.assembly.at_once import glued_together
from popsim.assembly.faces import turns
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof
from popsim.assembly.twins import apart
from popsim.assembly.unmaking import find_order
from popsim.design import Card, Design
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation import fold_design
from popsim.verification.random_designs import random_design

CARD = Card(x=(-80, 80), depth=120)

TURNS = (3, 0, 4, 6, 5, 5, 1)
"""Of the orders of random designs that were found before turns counted; their pieces were not all the same."""


def kit_of(design: Design) -> Kit:
    return Kit(lay_out(design), fold_design(design, 45).sweep)


@cache
def boxes() -> Kit:
    """Two boxes, mirror images of each other."""
    pair = card_pair(CARD)
    return kit_of(
        assemble(CARD, [BoxFold.plain(f"M{k}", pair, 20, 30, (x, x + 40)) for k, x in ((1, -60), (2, 20))])
    )


def steps(kit: Kit) -> list[Proof]:
    return [proof for proof in glued_together(find_order(kit).proofs) if proof.joints]


def number(kit: Kit, *parts: str) -> int:
    """The step in which two parts are joined."""
    return next(
        k
        for k, proof in enumerate(steps(kit))
        if any(set(kit.joints[n].parts) == set(parts) for n in proof.joints)
    )


def test_mirror_images_are_twins_of_each_other_and_nothing_else_is() -> None:
    twins = boxes().twins
    assert all(name in twins[twin] for name in twins for twin in twins[name])
    assert all(name not in twins[name] for name in twins)
    parts = {frozenset(boxes().joints[name].parts): name for name in twins}
    back, front = parts[frozenset(("M1.L", "M1.B_L"))], parts[frozenset(("M2.L", "M2.F_L"))]
    assert twins[back] == {front}


def test_what_is_as_long_but_not_as_large_is_no_twin() -> None:
    pair = card_pair(CARD)
    lower = BoxFold.plain("M1", pair, 20, 30, (-60, -20))
    kit = kit_of(assemble(CARD, [lower, BoxFold.plain("M2", pair, 20, 45, (20, 60))]))
    one, other = ({name for name, joint in kit.joints.items() if set(joint.parts) & own} for own in mirrored(kit))
    assert not any(kit.twins[name] & other for name in one & kit.twins.keys())


def mirrored(kit: Kit) -> tuple[set[str], set[str]]:
    """The parts of both boxes."""
    one, other = ({name for name in kit.outlines if name.startswith(box)} for box in ("M1.", "M2."))
    return one, other


def test_mirrored_parts_are_glued_in_neighbouring_steps() -> None:
    kit = boxes()
    assert abs(number(kit, "M1.T_G", "M1.C") - number(kit, "M2.T_G", "M2.C")) <= 1
    assert abs(number(kit, "M1.L", "M1.B_L") - number(kit, "M2.L", "M2.F_L")) <= 1
    tents = [TentFold(f"M{k}", card_pair(CARD), (x, x + 20), 20, 25) for k, x in enumerate((-60, -10, 40), 1)]
    kit = kit_of(assemble(CARD, tents))
    page = "G" if number(kit, "G", "M1.T_3") != number(kit, "G", "M2.T_3") else "B"
    leg = {"G": "T_3", "B": "T_4"}[page]
    assert abs(number(kit, page, f"M1.{leg}") - number(kit, page, f"M3.{leg}")) == 1


def test_pairs_that_are_glued_apart_are_counted() -> None:
    twins = {"a": frozenset("b"), "b": frozenset("a"), "c": frozenset()}
    assert apart(twins, [("a",), ("b",), ("c",)]) == 0
    assert apart(twins, [("a", "b"), ("c",)]) == 0
    assert apart(twins, [("a",), ("c",), ("b",)]) == 1


def test_less_is_turned_than_before() -> None:
    kits = [kit_of(random_design(seed, mechanisms=(1, 4)).design) for seed in range(len(TURNS))]
    assert sum(turns(kit, steps(kit)) for kit in kits) < 0.75 * sum(TURNS)

"""Steps that cannot be done are refused, with a reason: the negative controls of the execution."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from popsim.assembly.aside import swung_aside
from popsim.assembly.at_once import glued_together
from popsim.assembly.bundle import Bundle
from popsim.assembly.checking import check_order
from popsim.assembly.cut import Cut, cuts
from popsim.assembly.holding import Holding
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial, Trials
from popsim.assembly.unmaking import find_order
from popsim.assembly.way import Way
from popsim.design import Card
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.simulation import fold_design

CARD = Card(x=(-80, 80), depth=120)


@cache
def box() -> Kit:
    """A box on a card, with its recorded motion."""
    design = assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])
    return Kit(lay_out(design), fold_design(design, 45).sweep)


def joint(*parts: str) -> str:
    return next(name for name in box().flaps_of if set(box().joints[name].parts) == set(parts))


def test_the_order_found_is_accepted_when_it_is_checked() -> None:
    found = find_order(box())
    assert not found.left
    assert check_order(box(), [proof.joints for proof in found.proofs if proof.joints]) is None


@pytest.mark.parametrize("foot", ["M1.T_G", "G"])
def test_a_box_that_is_closed_before_its_backbone_is_glued_is_refused(foot: str) -> None:
    late = joint("M1.C", foot)
    others = [proof.joints for proof in find_order(box()).proofs if proof.joints]
    order = [tuple(name for name in names if name != late) for names in others]
    refusal = check_order(box(), [*[names for names in order if names], (late,)])
    assert refusal is not None
    assert refusal.joints == (late,)
    assert any(word in refusal.reason for word in ("M1.C", "shut in", "joined"))


def test_no_glue_and_no_finger_gets_into_a_closed_box() -> None:
    whole = Bundle.whole(box())
    closed = Holding(whole, joint("M1.C", "M1.T_G")).closed()
    pressed = Holding(whole, joint("M1.C", "M1.T_G")).pressed()
    assert isinstance(closed, Refusal)
    assert isinstance(pressed, Refusal)
    tucked = Holding(whole, joint("M1.C", "M1.T_G")).tucked(Stack(box()))
    assert isinstance(tucked, Refusal)
    assert "shut in" in closed.reason
    assert "finger" in pressed.reason


def test_a_side_of_the_box_is_reached_from_outside() -> None:
    apart = [one for proof in find_order(box()).proofs for one in proof.apart]
    loose = next(one for one in reversed(apart) if "M1.L" in one.parts and "G" not in one.parts)
    proof = Holding(loose.folded, joint("M1.R", "M1.F_R")).closed()
    assert isinstance(proof, Proof)
    assert proof.way is Way.CLOSED
    assert proof.blind == ()


def test_what_lies_under_other_paper_cannot_be_lifted() -> None:
    kit = box()
    whole, stack = Bundle.whole(kit), Stack(kit)
    taken = tuple(one.id for one in whole.crossing({"M1.C"}))
    for side in (1, -1):
        result = Trial(whole, stack, 0).cut(Cut(frozenset({"M1.C"}), taken, (), side))
        assert isinstance(result, Refusal)
        assert result.blockers


def test_what_is_cut_off_lies_on_top() -> None:
    kit = box()
    whole, stack = Bundle.whole(kit), Stack(kit)
    found = list(cuts(whole, stack))
    assert found
    for cut in found:
        above = stack.over if cut.side > 0 else stack.under
        assert all(above[name] <= cut.moved for name in cut.moved)


def test_layers_lie_as_they_do_in_the_open_box() -> None:
    """The ground is on top of the stack, the backdrop below all, and the backbone between the two sides."""
    stack = Stack(box())
    assert stack.over["G"] == frozenset()
    assert stack.under["B"] == frozenset()
    assert "M1.L" in stack.over["M1.C"]
    assert "M1.R" in stack.under["M1.C"]
    for name, above in stack.over.items():
        assert all(name in stack.under[other] for other in above)


def test_motions_are_rigid_and_end_where_things_belong() -> None:
    for proof in find_order(box()).proofs:
        for poses in proof.motion.values():
            turns = poses[:, :3, :3]
            assert np.allclose(turns @ np.swapaxes(turns, 1, 2), np.eye(3), atol=1e-6)


def test_what_hangs_on_nothing_else_is_brought_by_hand() -> None:
    """A backbone that is held by its top alone comes from beside; in the whole box it cannot be taken away."""
    kit = box()
    late = joint("M1.C", "M1.T_G")
    whole = Bundle.whole(kit)
    loose = whole.without({one.id for one in whole.crossing({"M1.C"})} - {late})
    proof = Holding(loose, late).brought()
    assert isinstance(proof, Proof)
    assert proof.way is Way.BROUGHT
    assert not proof.is_easy
    assert sorted(len(one.parts) for one in proof.apart)[0] == 1
    refusal = Holding(whole, late).brought()
    assert isinstance(refusal, Refusal)
    assert "taken away" in refusal.reason


def test_several_things_are_swung_aside_only_if_something_comes_off_then() -> None:
    """The backbone lies between the sides of its box: at least one of them goes aside first."""
    kit = box()
    late, stack = joint("M1.C", "M1.T_G"), Stack(kit)
    whole = Bundle.whole(kit)
    own = whole.only({name for name in whole.parts if name.startswith("M1.")})
    loose = own.without(set(own.glued) - {late})
    chain = swung_aside(loose, Trials(stack), 0, lambda trial: [cut for cut in trial.cuts if cut.taken])
    assert len(chain) > 1
    assert not any(proof.joints for proof in chain[:-1])
    assert chain[-1].joints == (late,)
    assert swung_aside(loose, Trials(stack), 0, lambda trial: []) == ()


def test_the_card_stays_and_its_other_page_is_folded_over() -> None:
    """What is lighter moves in the pictures, whichever side of the line was turned in thought."""
    for proof in find_order(box()).proofs:
        if proof.way is Way.FOLDED:
            for name, poses in proof.motion.items():
                assert np.allclose(poses, poses[0]) == (name not in proof.movers)


def test_what_is_glued_open_alike_is_pressed_by_one_folding() -> None:
    kit = box()
    whole = Bundle.whole(kit)
    names = [joint("M1.R", "M1.F_R"), joint("M1.B_L", "M1.B_R")]
    loose = whole.only({name for name in whole.parts if name.startswith("M1.")} - {"M1.C"})
    first = Holding(loose.without({names[1]}), names[0]).closed()
    second = Holding(loose, names[1]).closed()
    assert isinstance(first, Proof)
    assert isinstance(second, Proof)
    (both,) = glued_together([first, second])
    assert both.joints == (*first.joints, *second.joints)
    assert both.apart == first.apart
    assert glued_together([first, replace(second, degrees=75.0)])[1].joints == second.joints

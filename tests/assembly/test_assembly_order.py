"""The order of gluing: laws over random designs, and what common sense says of small ones."""

import re
from collections import Counter

import pytest

from popsim.assembly import AssemblyPlan, plan_assembly
from popsim.design import Card
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.pair import PairKind
from popsim.mechanisms.step_fold import StepFold
from popsim.verification.random_designs import random_design

CARD = Card(x=(-80, 80), depth=120)


@pytest.fixture(scope="module", params=range(4))
def plan(request: pytest.FixtureRequest) -> AssemblyPlan:
    return plan_assembly(lay_out(random_design(request.param, mechanisms=(1, 4)).design))


def respects(order: tuple[str, ...], before: tuple[tuple[str, str], ...]) -> bool:
    rank = {name: k for k, name in enumerate(order)}
    return all(rank[first] < rank[second] for first, second in before)


def test_every_joint_is_glued_once_after_what_it_waits_for(plan: AssemblyPlan) -> None:
    assert Counter(plan.order) == Counter({flap.joint.id for flap in plan.layout.flaps})
    assert respects(plan.order, plan.before)
    assert tuple(name for step in plan.steps for name in step.joints) == plan.order


def test_the_reverse_order_would_be_noticed(plan: AssemblyPlan) -> None:
    assert not respects(plan.order[::-1], plan.before) or not plan.before


def test_numbers_follow_the_order(plan: AssemblyPlan) -> None:
    assert [plan.layout.numbers[name] for name in plan.order] == list(range(1, len(plan.order) + 1))


def test_steps_name_pieces_that_exist_and_each_number_once(plan: AssemblyPlan) -> None:
    names = {piece.name for piece in plan.layout.pieces}
    lists = [found for step in plan.steps for found in re.findall(r"flaps? ([\d, and]+) of", step.text)]
    words = Counter(int(number) for found in lists for number in re.findall(r"\d+", found))
    assert words == Counter(plan.layout.numbers.values())
    for step in plan.steps:
        assert set(step.pieces) <= names
        named = re.findall(r"piece ([\w./+-]+?)(?=[\s.]*(?:\s|$))", step.text)
        assert {name.rstrip(".") for name in named} <= names
    assert [step.number for step in plan.steps] == list(range(1, len(plan.steps) + 1))


def test_every_piece_is_folded_once_when_it_is_first_used(plan: AssemblyPlan) -> None:
    folded = Counter(re.findall(r"Fold piece (\S+) along", plan.text))
    expected = {
        p.name for p in plan.layout.pieces if p.folds and any(p.name in s.pieces for s in plan.steps[1:-1])
    }
    assert folded == Counter(expected)


def position(plan: AssemblyPlan, *parts: str) -> int:
    (joint,) = (name for name in plan.order if set(joint_parts(plan, name)) == set(parts))
    return plan.order.index(joint)


def joint_parts(plan: AssemblyPlan, name: str) -> tuple[str, str]:
    return next(joint.parts for joint in plan.layout.joints if joint.id == name)


def test_a_box_is_closed_round_its_backbone_and_then_stood_on_the_card() -> None:
    plan = plan_assembly(lay_out(assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])))
    spine, foot = position(plan, "M1.C", "M1.T_G"), position(plan, "M1.C", "G")
    sides = [position(plan, "G", "M1.L"), position(plan, "B", "M1.R")]
    closing = [
        plan.order.index(name) for name in plan.order if not {"M1.C", "G", "B"} & set(joint_parts(plan, name))
    ]
    assert len(closing) == 2
    assert spine < min(closing)
    assert max(closing) < foot < min(sides)


def test_what_stands_on_a_box_is_glued_while_the_box_is_open_below() -> None:
    lower = BoxFold.plain("M1", card_pair(CARD), 30, 30, (-40, 40))
    upper = BoxFold.plain("M2", next(p for p in lower.pairs() if p.kind is PairKind.OPENING), 12, 20, (-15, 15))
    plan = plan_assembly(lay_out(assemble(CARD, [lower, upper])))
    assert position(plan, "M1.T_G", "M2.L") < position(plan, "G", "M1.L")
    assert position(plan, "M1.T_B", "M2.R") < position(plan, "G", "M1.C")


def test_a_step_meets_the_ground_after_the_box_it_leans_on() -> None:
    lower = BoxFold.plain("M1", card_pair(CARD), 30, 30, (-40, 40))
    corner = next(p for p in lower.pairs() if p.kind is PairKind.CORNER and "G" in p.patches)
    plan = plan_assembly(lay_out(assemble(CARD, [lower, StepFold("M2", corner, (-10, 10), 15, 15)])))
    assert position(plan, "M1.L", "M2.tread") < position(plan, "G", "M1.L") < position(plan, "G", "M2.riser")


def test_a_divided_card_is_joined_before_anything_stands_on_it() -> None:
    wide = Card(x=(-150, 150), depth=200)
    plan = plan_assembly(lay_out(assemble(wide, [BoxFold.plain("M1", card_pair(wide), 20, 30, (-30, 30))])))
    card = [k for k, name in enumerate(plan.order) if all(p[0] in "GB" for p in joint_parts(plan, name))]
    feet = [k for k, name in enumerate(plan.order) if len({p[0] in "GB" for p in joint_parts(plan, name)}) == 2]
    assert card
    assert max(card) < min(feet)
    seams = [k for k in card if plan.order[k].startswith("seam")]
    assert max(seams) < min(set(card) - set(seams))


def test_same_layout_same_plan() -> None:
    one, other = (plan_assembly(lay_out(random_design(3, mechanisms=(1, 3)).design)) for _ in range(2))
    assert one.text == other.text
    assert one.order == other.order

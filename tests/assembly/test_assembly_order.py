"""The order of gluing: laws over random designs, and what common sense says of small ones."""

import re
from collections import Counter

import pytest

from popsim import wording
from popsim.assembly import AssemblyPlan, StepKind, plan_assembly
from popsim.design import Card, Design
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.pair import PairKind
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation import fold_design
from popsim.verification.random_designs import random_design

CARD = Card(x=(-80, 80), depth=120)


def planned(design: Design) -> AssemblyPlan:
    return plan_assembly(lay_out(design), fold_design(design, 45).sweep)


@pytest.fixture(scope="module", params=range(4))
def plan(request: pytest.FixtureRequest) -> AssemblyPlan:
    return planned(random_design(request.param, mechanisms=(1, 4)).design)


def test_every_joint_is_glued_once(plan: AssemblyPlan) -> None:
    assert Counter(plan.order) == Counter({flap.joint.id for flap in plan.layout.flaps})
    assert tuple(name for step in plan.steps for name in step.joints) == plan.order


def test_a_way_is_found_for_every_step_and_it_folds_flat(plan: AssemblyPlan) -> None:
    assert plan.unproved == ()
    for step in plan.steps[1:-1]:
        assert step.evidence is not None
        assert step.evidence.feasible
        assert step.evidence.samples >= 2
        assert step.evidence.folded is not None
        assert step.evidence.folded.gap < 0.3
        assert step.evidence.folded.thickness < 0.3


def test_steps_show_what_they_change(plan: AssemblyPlan) -> None:
    for step in plan.steps[1:-1]:
        assert step.before is not None
        assert step.after is not None
        assert set(step.before.poses) == set(step.after.poses)
        assert set(step.motion) <= set(step.after.poses)
        assert {part for part, _ in step.flaps} == set(step.joints)
        assert step.kind in (StepKind.LAY, StepKind.FOLD)
        if step.evidence is not None and step.evidence.lying:
            assert step.motion


def test_numbers_follow_the_order(plan: AssemblyPlan) -> None:
    assert [plan.layout.numbers[name] for name in plan.order] == list(range(1, len(plan.order) + 1))


def test_steps_name_pieces_that_exist_and_each_number_once(plan: AssemblyPlan) -> None:
    names = {piece.name for piece in plan.layout.pieces}
    lists = [
        found for step in plan.steps for found in re.findall(r"flaps? ([\d, and]+) (?:of|to the same)", step.text)
    ]
    words = Counter(int(number) for found in lists for number in re.findall(r"\d+", found))
    assert words == Counter(plan.layout.numbers.values())
    for step in plan.steps:
        assert set(step.pieces) <= names
        named = re.findall(r"piece ([\w./+-]+?)(?=[\s.,]*(?:\s|$))", step.text)
        assert {name.rstrip(".,") for name in named} <= names
    assert [step.number for step in plan.steps] == list(range(1, len(plan.steps) + 1))


def test_each_step_is_one_sentence(plan: AssemblyPlan) -> None:
    for step in plan.steps:
        assert re.fullmatch(r"[A-Z][^.!?]*\.", step.text.replace(" 0.", " 0")), step.text
        assert len(step.text) < 200
    assert wording.FOLD_FIRST in plan.text


def test_what_is_folded_as_shown_is_shown(plan: AssemblyPlan) -> None:
    parts = {piece.name: set(piece.motions) for piece in plan.layout.pieces}
    for step in plan.steps:
        for named in re.findall(r"Fold ((?:piece \S+(?:, | and )?)+) flat as shown", step.text):
            assert step.before is not None
            for name in re.findall(r"piece ([^\s,]+)", named):
                assert parts[name] & set(step.before.poses)


def test_where_paper_is_held_open_the_step_says_to_open_it(plan: AssemblyPlan) -> None:
    for step in plan.steps[1:-1]:
        assert step.evidence is not None
        assert ("open the paper as shown" in step.text.lower()) == (step.evidence.degrees is not None)


def test_the_ease_adds_up(plan: AssemblyPlan) -> None:
    assert plan.ease.steps == len(plan.steps)
    assert plan.ease.joints == len(plan.order)
    assert plan.ease.unproved == 0
    assert 0 <= plan.ease.standing <= plan.ease.joints
    assert plan.ease.minutes > plan.ease.joints


def position(plan: AssemblyPlan, *parts: str) -> int:
    (joint,) = (name for name in plan.order if set(joint_parts(plan, name)) == set(parts))
    return plan.order.index(joint)


def joint_parts(plan: AssemblyPlan, name: str) -> tuple[str, str]:
    return next(joint.parts for joint in plan.layout.joints if joint.id == name)


def test_a_box_is_closed_round_its_backbone_and_then_stood_on_the_card() -> None:
    plan = planned(assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))]))
    spine, foot = position(plan, "M1.C", "M1.T_G"), position(plan, "M1.C", "G")
    inner = [k for k, name in enumerate(plan.order) if not {"M1.C", "G", "B"} & set(joint_parts(plan, name))]
    assert spine < max(inner) < foot < position(plan, "B", "M1.R")
    assert plan.ease.standing == plan.ease.blind == 0


def test_what_stands_on_a_box_is_glued_before_the_box_stands_on_the_card() -> None:
    lower = BoxFold.plain("M1", card_pair(CARD), 30, 30, (-40, 40))
    upper = BoxFold.plain("M2", next(p for p in lower.pairs() if p.kind is PairKind.OPENING), 12, 20, (-15, 15))
    plan = planned(assemble(CARD, [lower, upper]))
    assert position(plan, "M1.T_G", "M2.L") < position(plan, "G", "M1.L")
    assert position(plan, "M1.T_B", "M2.R") < position(plan, "G", "M1.C")


def test_one_side_of_everything_is_glued_before_the_card_closes_on_the_other() -> None:
    tents = [TentFold(f"M{k}", card_pair(CARD), (x, x + 20), 20, 25) for k, x in enumerate((-60, -20, 20), 1)]
    plan = planned(assemble(CARD, tents))
    (last,) = (step for step in plan.steps if step.number == len(plan.steps) - 1)
    assert len(last.joints) == 3
    assert len({part for name in last.joints for part in joint_parts(plan, name)} & {"G", "B"}) == 1


def test_a_divided_card_is_joined_before_anything_stands_on_it() -> None:
    wide = Card(x=(-150, 150), depth=200)
    plan = planned(assemble(wide, [BoxFold.plain("M1", card_pair(wide), 20, 30, (-30, 30))]))
    card = [k for k, name in enumerate(plan.order) if all(p[0] in "GB" for p in joint_parts(plan, name))]
    feet = [k for k, name in enumerate(plan.order) if len({p[0] in "GB" for p in joint_parts(plan, name)}) == 2]
    assert card
    assert max(card) < min(feet)


def test_same_layout_same_plan() -> None:
    one, other = (planned(random_design(3, mechanisms=(1, 2)).design) for _ in range(2))
    assert one.text == other.text
    assert one.order == other.order

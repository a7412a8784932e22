"""The theory of whole designs: margins that can be computed by hand, and breaches of exactly one condition."""

import numpy as np
import pytest

from popsim.design import Card, Design
from popsim.mechanisms import Mechanism, PairKind, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1
from popsim.mechanisms.v_fold_2 import VFold2
from popsim.validity import examine
from popsim.validity.clear import TOUCH

CARD = Card(x=(-150.0, 150.0), depth=160.0)
BASE = card_pair(CARD)


def pairs_of(mechanism: Mechanism, kind: PairKind) -> list:
    return [pair for pair in mechanism.pairs() if pair.kind is kind]


def nested() -> list[Mechanism]:
    """Box, box on top, tent on that, steps in two kinds of corner (the combined example of the geometry notes)."""
    low = BoxFold.plain("M1", BASE, 40.0, 30.0, (-50.0, 50.0))
    high = BoxFold.plain("M2", pairs_of(low, PairKind.OPENING)[0], 20.0, 30.0, (-20.0, 20.0))
    tent = TentFold("M3", pairs_of(high, PairKind.OPENING)[0], (-15.0, 15.0), 15.0, 10.0)
    beside = StepFold("M4", pairs_of(low, PairKind.CORNER)[0], (-40.0, 40.0), 20.0, 15.0)
    corner = StepFold("M5", pairs_of(high, PairKind.CORNER)[0], (-10.0, 10.0), 10.0, 15.0)
    return [low, high, tent, beside, corner]


def broken(design: Design) -> dict[str, float]:
    """Broken conditions by aspect and subject, with their margins."""
    return {f"{c.aspect} {c.subject}": c.margin for c in examine(design).conditions if not c.holds}


def test_nested_example_holds_in_every_aspect() -> None:
    theory = examine(assemble(CARD, nested()))
    assert theory.holds
    assert {condition.aspect for condition in theory.conditions} == {"foldable", "stable", "contained"}
    assert set(theory.roles) == {patch.id for patch in theory.design.popup_patches}


def test_ranges_are_those_of_section_3_3_2() -> None:
    ranges = examine(assemble(CARD, nested())).ranges
    assert ranges["M1"] == pytest.approx((-90.0, 90.0))
    assert ranges["M2"] == pytest.approx((-40.0, 40.0))
    assert ranges["M3"] == pytest.approx((-15.0, 15.0))


@pytest.mark.parametrize("gap", [5.0, 0.0, -20.0])
def test_margin_between_two_boxes_is_the_gap_between_their_closing_ranges(gap: float) -> None:
    first = BoxFold.plain("M1", BASE, 20.0, 30.0, (-70.0, -30.0))
    second = BoxFold.plain("M2", BASE, 10.0, 30.0, (-30.0 + 30.0 + gap, 40.0))
    design = assemble(CARD, [first, second])
    margins = [c.margin for c in examine(design).conditions if c.subject == "M1, M2"]
    assert margins == pytest.approx([gap + TOUCH])
    assert (broken(design) == {}) == (gap >= 0)


def test_what_leans_over_the_neighbours_roof_is_refused_although_the_boxes_are_apart() -> None:
    low = BoxFold.plain("M1", BASE, 15.0, 15.0, (-60.0, -20.0))
    tall = BoxFold.plain("M2", BASE, 15.0, 50.0, (12.0, 60.0))
    vee = VFold2("M3", pairs_of(low, PairKind.OPENING)[0], -25.0, 15.0, 80.0, 1)
    assert broken(assemble(CARD, [low, tall])) == {}
    reach = -25.0 + 80.0 / np.sqrt(2)
    assert broken(assemble(CARD, [low, tall, vee])) == pytest.approx({"clear M1, M2": -3.0 - reach + TOUCH})


def test_box_taller_than_the_page_sticks_out_by_width_plus_height_less_depth() -> None:
    box = BoxFold.plain("M1", BASE, 40.0, 135.0, (-20.0, 20.0))
    assert broken(assemble(CARD, [box])) == pytest.approx({"contained M1": 160.0 - 175.0}, abs=1e-5)


@pytest.mark.parametrize("page", ["G", "B"])
def test_where_a_page_is_cut_smaller_than_the_card_the_page_counts(page: str) -> None:
    box = BoxFold.plain("M1", BASE, 40.0, 100.0, (-20.0, 20.0))
    design = assemble(CARD, [box])
    assert broken(design) == {}
    cut = [
        patch
        if patch.id != page
        else patch.model_copy(update={"outline": [(x, 0.75 * y, z) for x, y, z in patch.outline]})
        for patch in design.patches
    ]
    smaller = design.model_copy(update={"patches": tuple(cut)})
    assert broken(smaller) == pytest.approx({"contained M1": 0.75 * 160.0 - 140.0}, abs=1e-5)


def test_box_without_pairs_shears() -> None:
    box = BoxFold("M1", BASE, 40.0, BoxFold.plain("M1", BASE, 40.0, 30.0, (0.0, 50.0)).tops, ())
    assert set(broken(assemble(CARD, [box]))) == {"stable M1"}


def test_side_of_other_length_breaks_b_plus_r_alone() -> None:
    box = BoxFold.plain("M1", BASE, 40.0, 30.0, (0.0, 50.0))
    design = assemble(CARD, [box])
    moved = design.model_dump()
    for part in (*moved["patches"], *moved["hinges"]):
        for field in ("outline", "axis"):
            if field in part and not (part["id"] == "h0" or part["id"] in "GB"):
                part[field] = [(x, -50.0, z) if y < -39 and z < 1 else (x, y, z) for x, y, z in part[field]]
    names = [c.name for c in examine(Design.model_validate(moved)).conditions if not c.holds]
    assert any("b + r = c + t_b" in name for name in names)
    assert not any("l = c" in name for name in names)


def turned_over(design: Design, name: str) -> Design:
    """The design with one crease stated to the other side."""
    hinges = [
        hinge.model_copy(update={"crease": tuple(-x for x in hinge.crease)}) if hinge.id == name else hinge
        for hinge in design.hinges
    ]
    return Design.model_validate({**design.model_dump(), "hinges": [hinge.model_dump() for hinge in hinges]})


def test_margin_of_creases_is_how_far_they_stand_out_at_90_degrees() -> None:
    """A front pair, w wide, is turned by 90 degrees, the tops too."""
    box = BoxFold.plain("M1", BASE, 40.0, 30.0, (0.0, 50.0))
    found = [c for c in examine(assemble(CARD, [box])).conditions if "creases" in c.name]
    assert [(c.aspect, c.subject) for c in found] == [("foldable", "M1")]
    assert found[0].margin == pytest.approx(40.0)


@pytest.mark.parametrize(
    "mechanism",
    [
        BoxFold.plain("M1", BASE, 40.0, 30.0, (0.0, 50.0)),
        VFold1("M1", BASE, 20.0, 30.0, 40.0, 1),
        VFold2("M1", BASE, 20.0, 30.0, 40.0, -1),
    ],
    ids=lambda mechanism: mechanism.type,
)
def test_each_crease_stated_the_wrong_way_is_refused(mechanism: Mechanism) -> None:
    """As a crease; but a front pair that bulges inward is a back pair, and cuts the roof."""
    design = assemble(CARD, [mechanism])
    creases = [hinge.id for hinge in design.hinges if hinge.crease is not None and hinge.kind != "central"]
    assert creases and examine(design).holds
    for name in creases:
        found = [c for c in examine(turned_over(design, name)).conditions if not c.holds]
        assert {c.subject for c in found} == {"M1"}
        assert any("creases" in c.name or "sweeps" in c.name for c in found)


def test_patch_without_mechanism_is_not_covered_by_the_theory() -> None:
    design = assemble(CARD, nested())
    less = design.model_copy(update={"mechanisms": design.mechanisms[:-1]})
    less.__dict__.pop("owner", None)
    assert set(broken(less)) == {"foldable M5.riser, M5.tread"}


def test_unknown_type_and_wrong_base_are_conditions_not_crashes() -> None:
    design = assemble(CARD, nested())
    records = list(design.mechanisms)
    records[4] = records[4].model_copy(update={"type": "pull-tab"})
    records[3] = records[3].model_copy(update={"base": ("G", "M2.L")})
    changed = Design.model_validate({**design.model_dump(), "mechanisms": [r.model_dump() for r in records]})
    found = {c.subject: c.name for c in examine(changed).conditions if c.aspect == "foldable" and not c.holds}
    assert "pull-tab" in found["M5"] and "step-fold" in found["M5"]
    assert "shares no fold line" in found["M4"]


def test_no_mechanisms_means_no_theory() -> None:
    design = assemble(CARD, nested())
    bare = Design.model_validate({**design.model_dump(), "mechanisms": []})
    assert examine(bare).conditions == ()

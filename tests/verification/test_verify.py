"""The verdict: what passes, what is refused, for the right reason, and where theory and simulation part."""

import json
from dataclasses import replace

import numpy as np
import pytest
from folding_designs import (
    CARD,
    CARD_PAIR,
    checked,
    layered,
    leaning,
    mismatched_box,
    overlapping_boxes,
    pair_inside,
    plain_box,
    shearing_box,
    slanted_box,
    too_tall,
    tower,
    wedges,
)

from popsim.geometry.rigid import turns_about
from popsim.mechanisms import Condition, assemble
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation.extents import reopening
from popsim.simulation.gaps import loop_gaps
from popsim.verification import Finding, Measure, Settings, Verdict, verify
from popsim.verification.evidence import gather
from popsim.verification.judge import judge


@pytest.mark.parametrize("design", [tower()[0], wedges()[0], layered()[0]], ids=["tower", "wedges", "layered"])
def test_sound_designs_pass_in_theory_and_simulation(design):
    verdict = verify(design)
    assert verdict.passed
    assert verdict.grade == "rigid"
    assert all(finding.theory and finding.simulation for finding in verdict.findings)
    assert {measure.name for measure in verdict.agreement} == {
        "distance from closed form",
        "distance from analytic closing range",
    }


REFUSED = {
    "box without end pairs shears": (shearing_box, "stable", "free motions"),
    "b + r != c + t_b": (lambda: mismatched_box(2), "foldable", "loop gap"),
    "ranges overlap by 20 mm": (overlapping_boxes, "clear", "crossing"),
    "v-fold leans over a taller neighbour": (leaning, "clear", "crossing"),
    "pair inside the profile": (lambda: pair_inside(0, 60), "clear", "crossing"),
    "pair through the backbone": (lambda: pair_inside(0, 10), "clear", "crossing"),
    "box taller than the page": (too_tall, "contained", "protrusion"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_the_simulation_refuses_each_fault_for_its_own_reason(name):
    make, aspect, reason = REFUSED[name]
    verdict = verify(make())
    assert not verdict.passed
    assert [finding.aspect for finding in verdict.findings if finding.simulation is False] == [aspect]
    assert verdict.finding(aspect).worst.name == reason
    assert not verdict.holes


@pytest.mark.parametrize("name", ["ranges overlap by 20 mm", "box taller than the page", "b + r != c + t_b"])
def test_the_theory_refuses_them_too(name):
    make, aspect, _ = REFUSED[name]
    finding = verify(make()).finding(aspect)
    assert finding.theory is False
    assert finding.disagreement is None
    assert finding.tightest.margin < 0


@pytest.mark.parametrize("pair", [("M.F_L", "M.F_R"), ("M.T_G", "M.T_B")])
def test_a_crease_stated_the_wrong_way_is_refused_by_both_and_is_no_hole(pair):
    box = plain_box()
    hinges = tuple(
        hinge.model_copy(update={"crease": tuple(-x for x in hinge.crease)})
        if set(hinge.patches) == set(pair)
        else hinge
        for hinge in box.hinges
    )
    verdict = verify(checked(box.model_copy(update={"hinges": hinges})))
    assert not verdict.passed
    assert verdict.holes == ()
    (refused,) = [finding for finding in verdict.findings if finding.simulation is False]
    assert refused.theory is False


def test_protrusion_is_measured():
    assert verify(too_tall()).finding("contained").worst.value == pytest.approx(20, abs=0.01)


def test_without_mechanisms_the_simulation_alone_decides():
    design = plain_box()
    verdict = verify(design.model_copy(update={"mechanisms": ()}))
    assert verdict.passed
    assert {finding.theory for finding in verdict.findings} == {None}
    assert "simulation alone decides" in verdict.notes[0]


def test_slanted_sides_are_graded_by_the_play_they_need():
    verdict = verify(slanted_box(1))
    assert verdict.grade == "within play"
    assert verdict.passed
    assert verdict.slack == ("foldable",)
    assert "play at hinge" in verdict.notes[0]
    assert any("slack" in note and "sides parallel to the backbone" in note for note in verdict.notes)
    assert verify(slanted_box(1), Settings(play=0.1)).grade == "refused"
    assert not verify(slanted_box(4)).passed


def test_what_opens_onto_another_branch_is_refused_under_that_name():
    """A tent whose ridge comes out on the other side of the pages: all loops close, and it is not where it was."""
    design = assemble(CARD, [TentFold("t", CARD_PAIR, (-20, 20), 30, 25)])
    settings = Settings()
    evidence = gather(design, settings)
    sweep = evidence.sweep
    assert judge(evidence, settings, "foldable")[0][-1].name == "opened pose off the first"
    turned = sweep.poses.copy()
    for name in ("t.T_3", "t.T_4"):
        turned[-1, sweep.index[name]] = turn_over(design.patch_by_id[name].points)
    other = replace(sweep, poses=turned)
    strayed = replace(evidence, sweep=other, gaps=loop_gaps(other, evidence.rig.forest.loops))
    assert strayed.gaps.largest < settings.rigid
    strayed = replace(strayed, reopened=reopening(other))
    measures, unjudged = judge(strayed, settings, "foldable")
    assert unjudged == ""
    assert measures[-1].name == "opened onto another branch"
    assert measures[-1].value == pytest.approx(50, abs=0.1)
    assert not measures[-1].holds


def turn_over(points: np.ndarray) -> np.ndarray:
    """Motion (4, 4) that takes a slope standing on its foot line to its mirror image in the page."""
    foot = points[np.abs(points[:, 2]).argmin()]
    rise = points[points[:, 2].argmax()] - foot
    angle = 2 * np.arctan2(rise[2], abs(rise[1])) * np.sign(rise[1])
    return turns_about(np.array([1.0, 0.0, 0.0]), foot, np.array(-angle))


@pytest.mark.parametrize("kind", ["tent-fold", "v-fold-1", "wing-fold"])
def test_what_a_mechanism_is_called_decides_nothing_and_slack_says_what_does_not_fit(kind):
    box = plain_box()
    record = box.mechanisms[0].model_copy(update={"type": kind})
    verdict = verify(checked(box.model_copy(update={"mechanisms": (record,)})))
    assert verdict.passed
    assert verdict.slack == ("foldable",)
    (note,) = verdict.notes
    assert note.startswith("slack: the theory refuses that it is foldable (M: its form: ")


def test_nothing_else_is_judged_where_loops_do_not_close():
    verdict = verify(mismatched_box(2))
    assert [finding.simulation for finding in verdict.findings[1:]] == [None] * 3
    assert all("do not close" in finding.unjudged for finding in verdict.findings[1:])


def test_theory_passing_what_the_simulation_refuses_is_a_hole():
    sound = Condition("clear", "M1", "ranges do not overlap", 3.0)
    broken = Condition("clear", "M1", "ranges do not overlap", -3.0)
    deep, shallow = Measure("crossing", 2.0, 0.05), Measure("crossing", 0.0, 0.05)
    assert Finding("clear", (sound,), (deep,)).disagreement == "hole"
    assert Finding("clear", (sound,), (deep,), founded=False).disagreement is None
    assert Finding("clear", (broken,), (shallow,)).disagreement == "slack"
    assert Finding("clear", (sound,), (shallow,)).disagreement is None
    assert Finding("clear", None, (deep,)).disagreement is None
    assert Finding("clear", (sound,), (), "torn").disagreement is None


def test_a_hole_or_a_differing_pose_fails_the_run():
    verdict = verify(plain_box())
    off = Measure("distance from closed form", 1.0, 0.001)
    differing = Verdict(verdict.findings, (off,), "rigid", {}, (), verdict.evidence)
    assert verdict.passed
    assert not differing.passed
    assert differing.holes == ("distance from closed form",)


def test_no_number_is_no_pass():
    assert not Measure("loop gap", float("nan"), 1.0).holds


def test_the_report_is_complete_json_and_the_same_every_time():
    texts = [verify(layered()[0]).to_json() for _ in range(2)]
    assert texts[0] == texts[1]
    report = json.loads(texts[0])
    assert report["passed"] is True
    assert [aspect["aspect"] for aspect in report["aspects"]] == ["foldable", "stable", "clear", "contained"]
    assert len(report["loop_gap"]["deg"]) == len(report["loop_gap"]["gap"]) == 361
    assert report["ranges"]["car"]["measured"] == pytest.approx([-95, 95], abs=0.01)


def test_rows_tell_margin_value_and_place():
    rows = verify(overlapping_boxes()).rows()
    clear = next(row for row in rows if row["aspect"] == "clear")
    assert clear["theory"] == clear["simulation"] == "refuse"
    assert clear["margin"] == "-20 mm"
    assert "M.F_L and N.B_L" in clear["where"]

"""The verdict as JUnit XML."""

from xml.etree import ElementTree

import pytest
from folding_designs import mismatched_box, overlapping_boxes, plain_box

from popsim.verification import Measure, Verdict, verify

COMPARISONS = ["distance from closed form", "distance from analytic closing range"]


@pytest.fixture(scope="module")
def sound() -> Verdict:
    return verify(plain_box())


def suite_of(verdict: Verdict, name: str = "box") -> ElementTree.Element:
    suite = ElementTree.fromstring(verdict.to_junit(name)).find("testsuite")
    assert suite is not None
    cases = suite.findall("testcase")
    assert int(suite.get("tests")) == len(cases)
    assert int(suite.get("failures")) == len(suite.findall("testcase/failure"))
    assert int(suite.get("skipped")) == len(suite.findall("testcase/skipped"))
    return suite


def test_a_sound_design_has_a_passing_case_per_aspect_and_comparison(sound):
    suite = suite_of(sound)
    names = [case.get("name") for case in suite.findall("testcase")]
    assert names == ["foldable", "stable", "clear", "contained", *COMPARISONS]
    assert suite.get("failures") == suite.get("skipped") == suite.get("errors") == "0"


def test_a_crossing_fails_with_depth_pair_and_broken_condition():
    suite = suite_of(verify(overlapping_boxes()))
    assert suite.get("failures") == "1"
    failure = suite.find("testcase[@name='clear']/failure")
    assert failure.get("type") == "refused"
    assert failure.get("message").startswith("crossing ") and "M.F_L and N.B_L" in failure.get("message")
    assert "margin -20 mm" in failure.text


def test_what_cannot_be_judged_is_skipped_with_its_reason():
    suite = suite_of(verify(mismatched_box(2)))
    assert suite.get("failures") == "1" and suite.get("skipped") == "3"
    assert "do not close" in suite.find("testcase[@name='clear']/skipped").get("message")


def test_a_contradiction_fails_as_a_hole(sound):
    off = Measure("distance from closed form", 1.0, 0.001, where="M.S_G at 90 deg")
    suite = suite_of(Verdict(sound.findings, (off,), "rigid", {}, (), sound.evidence))
    failure = suite.find("testcase[@name='distance from closed form']/failure")
    assert failure.get("type") == "hole"
    assert failure.get("message") == "distance from closed form 1 mm, at most 0.001 mm, M.S_G at 90 deg"


def test_the_same_verdict_gives_the_same_text_and_any_name_is_legal(sound):
    assert sound.to_junit("box") == verify(plain_box()).to_junit("box")
    assert suite_of(sound, 'a<b>&"\x01\ud800').get("name") == 'a<b>&"??'

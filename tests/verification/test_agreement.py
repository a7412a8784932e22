"""Poses beside their closed forms: what counts as agreement where a structure is soft."""

from dataclasses import replace

import numpy as np
import pytest
from folding_designs import plain_box

from popsim.geometry.rigid import translation
from popsim.simulation.blur import blur
from popsim.simulation.gaps import loop_gaps
from popsim.simulation.rig import Rig
from popsim.simulation.solver import BRISK
from popsim.simulation.sweep import fold
from popsim.validity import examine
from popsim.verification import Settings, verify
from popsim.verification.agreement import agreement
from popsim.verification.evidence import Evidence

THIN = plain_box(2, 108)
"""A parallelogram that is nearly singular one degree from closed."""

COARSE = Settings(angles=90)


def rough(design) -> Evidence:
    """The motion as MuJoCo left it, before it is polished."""
    rig = Rig(design, BRISK)
    sweep = fold(rig, 90, BRISK)
    return Evidence(rig, sweep, loop_gaps(sweep, rig.forest.loops))


@pytest.mark.parametrize("size", [(2, 108), (1, 108), (2, 140)])
def test_thin_parallelograms_agree_like_others(size):
    verdict = verify(plain_box(*size))
    assert verdict.passed
    assert {measure.name for measure in verdict.agreement} == {
        "distance from closed form",
        "distance from analytic closing range",
    }
    assert not any("not compared" in note for note in verdict.notes)


def test_soft_poses_whose_gap_explains_their_distance_are_left_out_and_told():
    evidence = rough(THIN)
    assert evidence.gaps.largest < 0.3
    (poses, _), left_out = agreement(evidence, examine(THIN), COARSE)
    assert "not compared" in left_out and "so soft" in left_out
    assert poses.holds


def test_a_distance_that_no_gap_explains_is_a_contradiction():
    """Shifting a whole mechanism by 0.01 mm opens its loops to the page by as much, and they are not soft."""
    evidence = verify(plain_box(), COARSE).evidence
    shifted = evidence.sweep.poses.copy()
    shifted[:, 2:] = translation(np.array([0.0, 0.0, 0.01])) @ shifted[:, 2:]
    moved = replace(evidence, sweep=replace(evidence.sweep, poses=shifted))
    (poses, _), left_out = agreement(moved, examine(plain_box()), COARSE)
    assert not poses.holds and poses.value == pytest.approx(0.01, rel=1e-3)
    assert left_out == ""


def test_blur_is_gap_over_stiffness():
    """Near 90 degrees a box is stiff: a gap of 1e-9 mm leaves no more than some times that."""
    evidence = verify(plain_box(), COARSE).evidence
    frames = np.array(evidence.sweep.closing_at([90, 60]))
    assert (blur(evidence.rig, evidence.sweep, frames) < 1e-5).all()

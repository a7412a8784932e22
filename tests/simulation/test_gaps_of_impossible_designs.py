"""Designs that cannot fold keep a gap in mm, which no softness hides."""

import numpy as np
import pytest
from folding_designs import mismatched_box, plain_box, slanted_box

from popsim.simulation import fold_design
from popsim.simulation.gaps import loop_gaps


def test_a_backbone_too_long_tears_the_loop():
    folding = fold_design(mismatched_box(5), 60)
    assert folding.gaps.largest > 1


def test_the_gap_grows_with_the_fault():
    gaps = [fold_design(mismatched_box(excess), 60).gaps.largest for excess in (0.01, 0.1, 1)]
    assert gaps == sorted(gaps)
    assert gaps[0] > 0.005


def test_slanted_sides_need_play():
    """About 0.2 mm for each mm of slant over a 40 mm side, and nothing without (Sec. 4.2)."""
    gaps = [fold_design(slanted_box(slant), 60).gaps.largest for slant in (1, 2, 4)]
    assert 0.1 < gaps[0] < 0.3
    assert gaps[1] / gaps[0] == pytest.approx(2, rel=0.15)
    assert gaps[2] / gaps[1] == pytest.approx(2, rel=0.15)


def test_gaps_are_measured_from_poses():
    folding = fold_design(plain_box(), 20)
    sweep = folding.sweep
    spread = sweep.poses.copy()
    spread[10, sweep.index["M.T_B"], :3, 3] += [0.0, 0.3, 0.4]
    broken = type(sweep)(sweep.design, sweep.theta, spread, sweep.states, True)
    gaps = loop_gaps(broken, tuple(h for h in sweep.design.hinges if "M.T_B" in h.patches))
    assert gaps.largest == pytest.approx(0.5, abs=1e-6)
    assert gaps.worst[1] == pytest.approx(sweep.theta[10])
    assert np.flatnonzero(gaps.by_angle > 0.1).tolist() == [10]

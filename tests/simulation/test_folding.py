"""Sound designs fold, and their poses are those of the closed forms."""

import numpy as np
import pytest
from folding_designs import layered, plain_box, scaled, tower, wedges

from popsim.geometry.frame import Side, page_poses
from popsim.geometry.rigid import transform
from popsim.simulation import fold_design
from popsim.simulation.extents import flatness, reopening, sweep_range
from popsim.simulation.folding import Folding
from popsim.simulation.schedule import Schedule
from popsim.simulation.solver import BRISK

POSE = 1e-4
"""mm; ten times better than what verification asks for."""

SOUND = {"tower": tower, "wedges": wedges, "layered": layered}


@pytest.fixture(scope="module", params=SOUND)
def folded(request: pytest.FixtureRequest) -> tuple[Folding, list]:
    design, parts = SOUND[request.param]()
    return fold_design(design, 60), parts


def test_loops_close_over_the_whole_sweep(folded):
    folding, _ = folded
    assert folding.sweep.complete
    assert folding.gaps.largest < 1e-6


def test_the_closed_card_is_flat_and_opens_to_where_it_was(folded):
    sweep = folded[0].sweep
    assert sweep.theta[sweep.closed] == 0
    assert flatness(sweep).value < 1e-3
    assert reopening(sweep).value < 1e-2


def test_poses_are_those_of_the_closed_forms(folded):
    folding, parts = folded
    sweep = folding.sweep
    inside = (sweep.degrees >= 1) & (sweep.degrees <= 179)
    for part in parts:
        for role, poses in part.poses(sweep.theta[inside]).items():
            name = part.patch_id(role)
            if name in sweep.index:
                stated = transform(poses, sweep.hulls[sweep.index[name]])
                assert np.abs(sweep.moved(name)[inside] - stated).max() < POSE, name


def test_closing_ranges_are_those_of_the_paper(folded):
    """Sec. 3.3.2: [x0 - d/2, x1 + d/2] for boxes, the v-fold ranges of both types, no motion of the rest."""
    folding, parts = folded
    for part in parts:
        names = tuple(part.patch_id(plate.role) for plate in part.plates())
        assert sweep_range(folding.sweep, names) == pytest.approx(part.closing_range(), abs=1e-4)


def test_pages_follow_the_fold_angle():
    sweep = fold_design(plain_box(), 30).sweep
    for name, side in (("G", Side.GROUND), ("B", Side.BACKDROP)):
        assert sweep.poses[:, sweep.index[name]] == pytest.approx(page_poses(side, sweep.theta), abs=1e-12)


@pytest.mark.parametrize("factor", [0.1, 10])
def test_size_does_not_matter(factor):
    design = plain_box()
    plain, other = fold_design(design, 30), fold_design(scaled(design, factor), 30)
    moved = other.sweep.poses.copy()
    moved[..., :3, 3] /= factor
    assert moved == pytest.approx(plain.sweep.poses, abs=1e-4)
    assert other.gaps.largest < 1e-6 * factor


def test_folding_is_deterministic():
    first, second = (fold_design(layered()[0], 20).sweep.poses for _ in range(2))
    assert np.array_equal(first, second)


def test_schedule_records_both_ways_and_slows_down_at_the_ends():
    schedule = Schedule(180, BRISK)
    assert np.degrees(schedule.recorded[[0, 180, 360]]) == pytest.approx([180, 0, 180])
    assert len(schedule.driven) == schedule.leg_steps.sum()
    assert schedule.driven[-1] == pytest.approx(np.pi)
    assert schedule.leg_steps[0] == BRISK.end_steps > schedule.leg_steps[90] == BRISK.steps


@pytest.mark.parametrize("angles", [7, 20, 45, 60, 100, 360])
def test_how_finely_the_card_is_driven_does_not_depend_on_what_is_recorded(angles):
    schedule, usual = Schedule(angles, BRISK), Schedule(180, BRISK)
    assert np.array_equal(schedule.stops[schedule.is_recorded], schedule.recorded)
    assert schedule.leg_steps.sum() >= usual.leg_steps.sum()
    strides = np.abs(np.diff(np.degrees(schedule.driven), prepend=180))
    at_end = np.abs(90 - np.degrees(schedule.driven)) > 87 + 1e-6
    assert strides.max() < 1 / BRISK.steps + 1e-9
    assert strides[at_end].max() < 1 / BRISK.end_steps + 1e-9


@pytest.mark.parametrize("angles", [7, 45, 60])
def test_few_recorded_angles_are_as_exact_as_many(angles):
    few, many = (fold_design(layered()[0], count) for count in (angles, 180))
    assert few.gaps.largest < 1e-6
    shared = few.sweep.poses[[0, angles, -1]], many.sweep.poses[[0, 180, -1]]
    assert shared[0] == pytest.approx(shared[1], abs=1e-6)

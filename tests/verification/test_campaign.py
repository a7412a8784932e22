"""Campaigns: what they count, what they save, and that they can find something."""

import json

import pytest

from popsim.design import load_design
from popsim.errors import InputError
from popsim.verification import Settings
from popsim.verification.campaign import plan, run_campaign
from popsim.verification.random_designs import FLAWS

COUNT = 2 * len(FLAWS)
SEED = 9
"""Gives small designs, so that the test is quick."""


@pytest.fixture(scope="module")
def campaign():
    return run_campaign(COUNT, seed=SEED, jobs=1)


def test_half_of_the_designs_are_valid_and_every_flaw_has_its_turn() -> None:
    flaws = [task.flaw for task in plan(COUNT, 0)]
    assert flaws.count(None) == COUNT // 2
    assert set(flaws) - {None} == set(FLAWS)


def test_longer_campaign_begins_with_the_shorter_one() -> None:
    assert list(plan(50, 3))[:20] == list(plan(20, 3))
    assert list(plan(20, 3)) != list(plan(20, 4))


def test_theory_and_simulation_agree(campaign) -> None:
    assert [each for _, each in campaign.disagreements if each.kind != "slack"] == []
    assert campaign.passed


def test_matrix_counts_every_design_once(campaign) -> None:
    assert set(campaign.matrices) == {"foldable", "stable", "clear", "contained"}
    for matrix in campaign.matrices.values():
        assert sum(matrix.values()) == COUNT
        assert matrix[True, True] >= COUNT // 2
        assert matrix[True, False] == 0
        assert matrix[False, False] > 0


def test_every_flaw_is_refused_for_a_reason(campaign) -> None:
    assert set(campaign.refusals) == set(FLAWS)
    assert all(reasons[""] == 0 for reasons in campaign.refusals.values())
    assert set(campaign.refusals["shear"]) == {"free motions"}
    assert set(campaign.refusals["overlap"]) == {"crossing"}
    assert set(campaign.refusals["tall"]) == {"protrusion"}


def test_residuals_of_valid_designs_are_small(campaign) -> None:
    assert campaign.residuals["loop gap"].value < 0.001
    assert campaign.residuals["crossing"].value == 0


def test_jobs_do_not_change_the_report(campaign) -> None:
    assert run_campaign(COUNT, seed=SEED, jobs=2).to_dict() == campaign.to_dict()


def test_report_is_plain_json(campaign) -> None:
    assert json.loads(json.dumps(campaign.to_dict()))["designs"] == COUNT


def test_disagreements_are_told_and_saved(tmp_path) -> None:
    """A check that cannot fail is worth nothing: tolerances that nothing can meet."""
    told = []
    strict = Settings(pose=1e-30, protruding=-1.0)
    found = run_campaign(2, seed=SEED, jobs=1, folder=tmp_path, progress=told.append, settings=strict)
    assert not found.passed
    assert [outcome.task.index for outcome in told] == [0, 1]
    first = found.outcomes[0]
    assert {each.kind for each in first.disagreements} == {"hole"}
    saved = load_design(tmp_path / "design-000000-hole.json")
    assert saved == first.task.draw().design


@pytest.mark.parametrize("wrong", [{"count": 0}, {"seed": -1}, {"jobs": 0}])
def test_nothing_to_do_is_refused(wrong) -> None:
    with pytest.raises(InputError, match="a campaign needs"):
        run_campaign(**{"count": 2, "seed": 0, "jobs": 1} | wrong)

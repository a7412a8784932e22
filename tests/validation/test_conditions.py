"""The geometric conditions confirmed over 300 random designs, and the record of a campaign over many more."""

import json
from pathlib import Path

import pytest

from popsim.verification import Settings
from popsim.verification.campaign import plan, run_campaign, summary
from popsim.verification.random_designs import FLAWS

CHUNKS, DESIGNS = 12, 25
"""Campaigns of their own, so that they spread over all cores: 300 designs."""

HERE = Path(__file__).parent
RECORD, TEXT = HERE / "campaign.json", HERE / "campaign.txt"
LEAST = 20_000
"""Designs in the recorded campaign; `popsim validate --seed 2014` and as many as it tells prints the same."""

NOT_REFUSED = ""
"""Reason of what was not refused for all its flaw: within play, which is slack of the theory."""

REASONS = {
    "inside-pair": {"crossing"},
    "lean": {"crossing"},
    "lengths": {"height above the closed plane", "loop gap", "sweeps that broke down"},
    "overlap": {"crossing"},
    "shear": {"free motions"},
    "tall": {"protrusion"},
    "wide": {"protrusion"},
}
"""By what each flaw may be refused."""


def told(report: dict) -> list[str]:
    return [line.split()[0] for line in summary(report).splitlines() if line.strip("-")]


@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_theory_and_simulation_agree_on_random_designs(chunk: int) -> None:
    campaign = run_campaign(DESIGNS, seed=1000 + chunk, jobs=1)
    assert [(outcome.task, each) for outcome, each in campaign.disagreements if each.kind != "slack"] == []
    assert all(set(found) <= REASONS[flaw] for flaw, found in campaign.refusals.items())
    largest = {name: residual.value for name, residual in campaign.residuals.items()}
    assert largest["loop gap"] <= Settings().rigid
    assert largest["distance from closed form"] <= Settings().pose
    assert largest["distance from analytic closing range"] <= Settings().closing_range


def test_these_designs_are_of_all_kinds() -> None:
    tasks = [task for chunk in range(CHUNKS) for task in plan(DESIGNS, 1000 + chunk)]
    assert {task.flaw for task in tasks} == {None, *FLAWS}
    assert {task.most for task in tasks} == {2, 4, 8, 16, 40}


@pytest.fixture(scope="module")
def record() -> dict:
    return json.loads(RECORD.read_text())


def test_the_recorded_campaign_is_large_and_found_nothing(record) -> None:
    assert record["designs"] >= LEAST
    assert record["passed"] is True
    assert {each["kind"] for each in record["disagreements"]} <= {"slack"}
    assert set(record["refusals"]) == set(FLAWS)
    assert sum(found.get(NOT_REFUSED, 0) for found in record["refusals"].values()) == len(record["disagreements"])
    for flaw, found in record["refusals"].items():
        assert set(found) - {NOT_REFUSED} <= REASONS[flaw]
        assert sum(found.values()) >= LEAST // 2 // len(FLAWS)
    for cells in record["matrices"].values():
        assert sum(cell["designs"] for cell in cells) == record["designs"]
        assert not any(cell["theory"] is True and cell["simulation"] is False for cell in cells)


def test_its_residuals_are_within_what_is_promised(record) -> None:
    largest = {name: found["value"] for name, found in record["residuals"].items()}
    assert largest["loop gap"] <= 0.001
    assert largest["distance from closed form"] <= 0.001
    assert largest["distance from analytic closing range"] <= 0.01


def test_its_text_is_what_the_command_prints(record) -> None:
    assert TEXT.read_text() == summary(record)


def test_a_new_campaign_is_told_in_the_same_form(record) -> None:
    """Same keys, same tables: the record is of this command."""
    report = run_campaign(2 * len(FLAWS), seed=9, jobs=1).to_dict()
    assert report.keys() == record.keys()
    assert set(report["residuals"]) == set(record["residuals"])
    assert {"aspect", "planted", "largest", "PASSED"} <= set(told(report)) <= set(told(record))

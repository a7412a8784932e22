"""What crosses between two recorded angles: four times as many angles lead to the same verdict."""

import pytest

from popsim.simulation import fold_design
from popsim.simulation.search import find_contacts
from popsim.verification import Settings
from popsim.verification.campaign import plan

USUAL, MANY = 180, 720
"""Recorded angles each way."""

TASKS = [task for task in plan(40, 4242) if task.flaw in (None, "inside-pair", "lean", "overlap")]


def crossing(design, angles: int) -> dict[tuple[str, str], float]:
    """Depths of all pairs that cross, mm."""
    folding = fold_design(design, angles)
    assert folding.sweep.complete
    tolerance = Settings().crossing
    found = find_contacts(folding.rig, folding.sweep, tolerance, play=folding.gaps.largest, resolution=10.0)
    return {contact.patches: contact.depth for contact in found}


@pytest.mark.parametrize("task", TASKS[::4], ids=lambda task: f"{task.flaw}")
def test_no_design_is_passed_for_what_crosses_between_two_angles(task) -> None:
    design = task.draw().design
    usual, many = crossing(design, USUAL), crossing(design, MANY)
    assert bool(usual) == bool(many) == (task.flaw is not None)
    assert set(usual) <= set(many)

"""What the simulation costs beside MuJoCo itself, and how that grows with the design."""

import mujoco
import numpy as np
import pytest
from boxes import row_of_boxes
from conftest import Report, cpu_seconds, exponent

from popsim.simulation.folding import fold_design
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.schedule import Schedule
from popsim.simulation.solver import BRISK
from popsim.simulation.sweep import PRESS_STEPS, fold

ANGLES = 180
ROUNDS = 7
MOST = 1.5
"""Of the sweep over the bare loop."""

PATCHES = (10, 20, 50, 100, 200, 500, 1000, 2000)
STEPS = 40


def bare_loop(rig: Rig) -> None:
    """Nothing but `mj_step`, with as many steps as a sweep and the pages driven as there."""
    schedule = Schedule(ANGLES, BRISK)
    turns = page_quaternions(schedule.driven)
    extra = schedule.total_steps + PRESS_STEPS - len(turns)
    model, data, rest = rig.model, rig.data, extra / len(turns)
    owed = 0.0
    for turn in turns:
        data.mocap_quat[:] = turn
        mujoco.mj_step(model, data)
        owed += rest
        while owed >= 1:
            mujoco.mj_step(model, data)
            owed -= 1


@pytest.mark.parametrize("patches", [12, 40, 100])
def test_sweep_costs_little_more_than_its_steps(patches: int, report: Report) -> None:
    design = row_of_boxes(patches)
    bare, sweep, whole = np.inf, np.inf, np.inf
    for _ in range(ROUNDS):  # in turns, so that a change of the machine's pace meets all
        one, other = Rig(design, BRISK), Rig(design, BRISK)
        bare = min(bare, cpu_seconds(lambda rig=one: bare_loop(rig), 1))
        sweep = min(sweep, cpu_seconds(lambda rig=other: fold(rig, ANGLES, BRISK), 1))
        whole = min(whole, cpu_seconds(lambda: fold_design(design, ANGLES), 1))
    report(
        f"sweep beside the bare mj_step loop, {len(design.patches)} patches",
        ("bare, s", "sweep, s", "ratio", "with rig, polish and gaps, s", "ratio"),
        [(bare, sweep, sweep / bare, whole, whole / bare)],
    )
    assert sweep <= MOST * bare


def test_step_cost_grows_linearly(report: Report) -> None:
    rows, sizes, costs = [], [], []
    for wanted in PATCHES:
        rig = Rig(row_of_boxes(wanted), BRISK)
        turns = page_quaternions(np.pi * np.linspace(0.7, 0.6, STEPS))

        def drive(rig: Rig = rig, turns: np.ndarray = turns) -> None:
            for turn in turns:
                rig.hold(turn)
                rig.step()

        cost = cpu_seconds(drive) / STEPS
        count = len(rig.design.patches)
        rows.append((count, cost * 1e6, cost * 1e6 / count))
        sizes.append(count)
        costs.append(cost)
    power = exponent(sizes, costs)
    report(f"cost of a step, exponent {power:.2f}", ("patches", "us per step", "us per step and patch"), rows)
    assert power < 1.2

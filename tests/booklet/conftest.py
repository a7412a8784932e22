"""The test build with its plan, and the folder that it is written to."""

import pytest
from built_pop_up import Built

from popsim.assembly import AssemblyPlan, plan_assembly
from popsim.layout import lay_out
from popsim.pipeline import RunSettings
from popsim.pipeline.calibration import calibration_design, deliver_calibration
from popsim.simulation import Sweep, fold_design


@pytest.fixture(scope="session")
def plan(sweep: Sweep) -> AssemblyPlan:
    """The plan of a box and a wedge on a card."""
    return plan_assembly(lay_out(calibration_design()), sweep)


@pytest.fixture(scope="session")
def sweep() -> Sweep:
    """The same as it folds."""
    return fold_design(calibration_design(), 180).sweep


@pytest.fixture(scope="session")
def built(plan: AssemblyPlan, sweep: Sweep, tmp_path_factory: pytest.TempPathFactory) -> Built:
    """The same as it is delivered."""
    folder = tmp_path_factory.mktemp("booklet") / "out"
    deliver_calibration(sweep, folder, RunSettings(), footer="made by a test", force=False)
    return Built(calibration_design(), plan, folder)

"""A small pop-up with a plan, and its booklet."""

import pytest
from built_pop_up import Built

from popsim.assembly import AssemblyPlan, plan_assembly
from popsim.booklet import write_booklet
from popsim.layout import lay_out
from popsim.pipeline.calibration import calibration_design

CHECKS = ("Measure the bars.", "Close the card.")


@pytest.fixture(scope="session")
def plan() -> AssemblyPlan:
    """The plan of a box and a wedge on a card."""
    return plan_assembly(lay_out(calibration_design()))


@pytest.fixture(scope="session")
def built(plan: AssemblyPlan, tmp_path_factory: pytest.TempPathFactory) -> Built:
    """The booklet of the same."""
    folder = tmp_path_factory.mktemp("booklet")
    design = calibration_design()
    write_booklet(plan, design, folder, name="Box & wedge", checks=CHECKS)
    return Built(design, plan, folder)

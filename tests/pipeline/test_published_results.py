"""Fig. 16 of the paper: what becomes of the hotel and of the tower where few patches are allowed."""

from pathlib import Path

import pytest

from popsim.fitting import FitSettings
from popsim.patches import PatchSettings
from popsim.pipeline import RunSettings, run_design


@pytest.mark.parametrize(
    ("name", "patches", "types"),
    [("hotel/hotel.glb", 18, ["box-fold", "box-fold"]), ("tower/tower.ply", 2, ["tent-fold"])],
)
def test_as_many_patches_as_published_become_the_same_mechanisms(
    name: str, patches: int, types: list[str], models: Path
) -> None:
    settings = RunSettings(fit=FitSettings(most_patches=patches), patches=PatchSettings(dpi=40))
    run = run_design(models / name, settings)
    assert [mechanism.type for mechanism in run.fit.mechanisms] == types
    assert run.verdict.passed

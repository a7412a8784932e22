"""Runs that several tests look at."""

from pathlib import Path

import pytest

from popsim.patches import PatchSettings
from popsim.pipeline import DesignRun, RunSettings, run_design


@pytest.fixture(scope="session")
def truck(models: Path) -> DesignRun:
    """The truck on coarse prints."""
    return run_design(models / "truck" / "truck.obj", RunSettings(patches=PatchSettings(dpi=60)))

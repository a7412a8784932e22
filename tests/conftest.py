"""Fixtures shared by all tests."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

# The same cases in every run, so that a commit is green or not; `HYPOTHESIS_PROFILE=explore` draws others.
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("explore", derandomize=False, deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def shared_meshes() -> Path:
    """Folder of real models kept beside the checkout; tests that need it are skipped without it."""
    folder = ROOT.parent / "shared" / "meshes"
    if not folder.is_dir():
        pytest.skip("the folder of real models is not beside this checkout")
    return folder


@pytest.fixture(scope="session")
def models() -> Path:
    """Folder of the project's own models."""
    return ROOT / "models"

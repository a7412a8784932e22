"""Fixtures shared by all tests."""

from pathlib import Path

import pytest

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

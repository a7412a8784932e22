"""FOLD files as the npm package `fold` reads them; skipped where node does not find it (set NODE_PATH)."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from printed_design import Printed

from popsim.export import export

SCRIPT = Path(__file__).with_name("check_fold.js")


@pytest.fixture(scope="module")
def node() -> str:
    path = shutil.which("node")
    if (
        path is None
        or subprocess.run([path, "-e", "require('fold')"], capture_output=True, check=False).returncode
    ):
        pytest.skip("node with the npm package fold is not there")
    return path


def test_crease_patterns_are_planar_and_their_faces_are_found_again(
    node: str, printed: Printed, tmp_path: Path
) -> None:
    files = export(printed.layout, tmp_path / "s.fold", "fold", texture_root=printed.folder)
    done = subprocess.run([node, SCRIPT, *files], capture_output=True, text=True, check=True)
    for file, found in zip(files, json.loads(done.stdout), strict=True):
        assert found["apart"] == found["spots"], file.name
        assert found["uncrossed"] == found["vertices"]
        assert found["single"] == found["edges"]
        assert found["missing"] == 0
    whole, *pieces = json.loads(done.stdout)
    for key in ("mountains", "valleys"):
        assert whole[key] == sum(piece[key] for piece in pieces) > 0

"""`popsim design` from model to folder."""

import inspect
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from time import sleep

import pytest

from popsim.cli.choices import parse_weights
from popsim.cli.design import design
from popsim.design import load_design
from popsim.fitting.ransac import Weights


@pytest.fixture
def block(tmp_path: Path) -> Path:
    """A plain block, as anybody would write it by hand."""
    corners = [(x, y, z) for x in (0, 4) for y in (0, 2) for z in (0, 2)]
    faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    path = tmp_path / "block.obj"
    path.write_text("\n".join(lines) + "\n")
    return path


def contents(folder: Path) -> dict[Path, bytes]:
    """Bytes of all files by their paths within a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_design_leaves_everything_that_is_promised_and_it_verifies(popsim, block: Path, tmp_path: Path) -> None:
    done = popsim("design", block, "-o", "out", "--dpi", 60)
    assert done.returncode == 0, done.stderr
    assert "PASSED" in done.stdout
    told = [line.split()[0] for line in done.stderr.splitlines()]
    assert told == ["aligning", "fitting", "cutting", "folding", "painting", "planning", "drawing"]
    names = {str(path) for path in contents(tmp_path / "out")}
    assert {"design.json", "report.json", "sheets.pdf", "assembly.md", "popup.png"} <= names
    assert {"instructions.pdf", "instructions.html"} <= names
    assert any(name.startswith("sheets") and name.endswith(".svg") for name in names)
    design = load_design(tmp_path / "out" / "design.json")
    assert {patch.texture for patch in design.patches if patch.texture} <= names
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["passed"] is True
    assert report["seed"] == 0
    assert report["command"].startswith("popsim design block.obj")
    checked = popsim("verify", "out/design.json", "--report", "verdict.json")
    assert checked.returncode == 0, checked.stdout
    assert json.loads((tmp_path / "verdict.json").read_text())["passed"] is True


@pytest.mark.skipif(sys.platform == "win32", reason="Windows interrupts otherwise")
@pytest.mark.parametrize("stage", ["fitting", "drawing"])
def test_interrupted_it_leaves_no_file_and_no_word_of_a_second_process(
    stage: str, block: Path, tmp_path: Path
) -> None:
    """Ctrl-C goes to all processes of a run; now and then a library swallows it, and the run goes on."""
    words = [sys.executable, "-m", "popsim", "design", block, "-o", tmp_path / "out", "--dpi", "60"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True, start_new_session=True) as run:
        assert run.stderr is not None
        next(line for line in run.stderr if line.startswith(stage))
        sleep(0.1)
        os.killpg(run.pid, signal.SIGINT)
        assert "beside.py" not in run.stderr.read(), "the second process tells of it"
    names = {str(path) for path in contents(tmp_path / "out")}
    assert (run.returncode, names) == (130, set()) or (run.returncode == 0 and "report.json" in names)


def test_test_build_is_printed_beside_the_design_and_goes_with_it(popsim, block: Path, tmp_path: Path) -> None:
    done = popsim("design", block, "-o", "out", "--dpi", 60, "--calibration")
    assert done.returncode == 0, done.stderr
    names = {str(path) for path in contents(tmp_path / "out")}
    assert {"sheets.pdf", "design.json", "calibration/sheets.pdf", "calibration/instructions.pdf"} <= names
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert set(report["files"]) | {"report.json"} == names
    assert report["command"].endswith("--calibration")
    assert len(load_design(tmp_path / "out" / "calibration" / "design.json").mechanisms) == 2
    assert load_design(tmp_path / "out" / "design.json").source is not None
    assert popsim("design", block, "-o", "out", "--dpi", 60, "--force").returncode == 0
    assert not (tmp_path / "out" / "calibration").exists()


def test_same_input_gives_the_same_bytes(popsim, block: Path, tmp_path: Path) -> None:
    for folder in ("one", "two"):
        assert popsim("design", block, "-o", folder, "--dpi", 60).returncode == 0
    one, two = (contents(tmp_path / name) for name in ("one", "two"))
    assert one == two


def test_folder_of_the_user_is_left_alone_without_force(popsim, block: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "design.json").write_text("mine")
    done = popsim("design", block, "-o", "out")
    assert done.returncode == 2
    assert "--force" in done.stderr
    assert (tmp_path / "out" / "design.json").read_text() == "mine"
    assert popsim("design", block, "-o", "out", "--dpi", 60, "--force").returncode == 0
    assert (tmp_path / "out" / "design.json").read_text() != "mine"


def test_the_usual_weights_are_those_of_fitting() -> None:
    said = inspect.signature(design).parameters["weights"].default
    assert parse_weights(said) == Weights()

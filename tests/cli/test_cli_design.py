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
from command import run_popsim

from popsim.cli.choices import parse_weights
from popsim.cli.design import design
from popsim.design import load_design
from popsim.fitting.ransac import Weights

WORDS = ("design", "block.obj", "--dpi", 60)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Holds a plain block, as anybody would write it by hand, and what is made of it."""
    corners = [(x, y, z) for x in (0, 4) for y in (0, 2) for z in (0, 2)]
    faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    folder = tmp_path_factory.mktemp("designs")
    (folder / "block.obj").write_text("\n".join(lines) + "\n")
    return folder


@pytest.fixture(scope="module")
def designed(folder: Path) -> subprocess.CompletedProcess[str]:
    """What is told of the design in `out`."""
    return run_popsim(folder, *WORDS, "-o", "out")


@pytest.fixture(scope="module")
def with_test_build(folder: Path) -> dict[Path, bytes]:
    """Contents of `built`, designed with the test build beside it."""
    done = run_popsim(folder, *WORDS, "-o", "built", "--calibration")
    assert done.returncode == 0, done.stderr
    return contents(folder / "built")


@pytest.fixture(scope="module")
def by_force(folder: Path, with_test_build: dict[Path, bytes]) -> dict[Path, bytes]:
    """Contents of the same folder, edited by the user, after a design without test build is written into it."""
    assert Path("calibration/design.json") in with_test_build
    (folder / "built" / "design.json").write_text("mine")
    done = run_popsim(folder, *WORDS, "-o", "built", "--force")
    assert done.returncode == 0, done.stderr
    return contents(folder / "built")


def contents(folder: Path) -> dict[Path, bytes]:
    """Bytes of all files by their paths within a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_design_leaves_everything_that_is_promised_and_it_verifies(
    designed: subprocess.CompletedProcess[str], folder: Path
) -> None:
    assert designed.returncode == 0, designed.stderr
    assert "PASSED" in designed.stdout
    told = [line.split()[0] for line in designed.stderr.splitlines()]
    assert told == ["aligning", "fitting", "cutting", "folding", "painting", "planning", "drawing"]
    names = {str(path) for path in contents(folder / "out")}
    assert {"design.json", "report.json", "sheets.pdf", "assembly.md", "popup.png"} <= names
    assert {"instructions.pdf", "instructions.html"} <= names
    assert any(name.startswith("sheets") and name.endswith(".svg") for name in names)
    design = load_design(folder / "out" / "design.json")
    assert {patch.texture for patch in design.patches if patch.texture} <= names
    report = json.loads((folder / "out" / "report.json").read_text())
    assert report["passed"] is True
    assert report["seed"] == 0
    assert report["command"].startswith("popsim design block.obj")
    checked = run_popsim(folder, "verify", "out/design.json", "--report", "verdict.json")
    assert checked.returncode == 0, checked.stdout
    assert json.loads((folder / "verdict.json").read_text())["passed"] is True


@pytest.mark.skipif(sys.platform == "win32", reason="Windows interrupts otherwise")
@pytest.mark.parametrize("stage", ["fitting", "drawing"])
def test_interrupted_it_leaves_no_file_and_no_word_of_a_second_process(
    stage: str, folder: Path, tmp_path: Path
) -> None:
    """Ctrl-C goes to all processes of a run; now and then a library swallows it, and the run goes on."""
    words = [sys.executable, "-m", "popsim", "design", folder / "block.obj", "-o", tmp_path / "out", "--dpi", "60"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True, start_new_session=True) as run:
        assert run.stderr is not None
        next(line for line in run.stderr if line.startswith(stage))
        sleep(0.1)
        os.killpg(run.pid, signal.SIGINT)
        assert "beside.py" not in run.stderr.read(), "the second process tells of it"
    names = {str(path) for path in contents(tmp_path / "out")}
    assert (run.returncode, names) == (130, set()) or (run.returncode == 0 and "report.json" in names)


def test_test_build_is_printed_beside_the_design_and_goes_with_it(
    with_test_build: dict[Path, bytes], by_force: dict[Path, bytes], folder: Path
) -> None:
    names = {str(path) for path in with_test_build}
    assert {"sheets.pdf", "design.json", "calibration/sheets.pdf", "calibration/instructions.pdf"} <= names
    report = json.loads(with_test_build[Path("report.json")])
    assert set(report["files"]) | {"report.json"} == names
    assert report["command"].endswith("--calibration")
    design, build = folder / "design.json", folder / "build.json"
    design.write_bytes(with_test_build[Path("design.json")])
    build.write_bytes(with_test_build[Path("calibration/design.json")])
    assert len(load_design(build).mechanisms) == 2
    assert load_design(design).source is not None
    assert by_force and not (folder / "built" / "calibration").exists()


@pytest.mark.usefixtures("designed")
def test_same_input_gives_the_same_bytes(by_force: dict[Path, bytes], folder: Path) -> None:
    """Whether written into no folder or by force into one that has other files."""
    assert by_force == contents(folder / "out")


def test_folder_of_the_user_is_left_alone_without_force(folder: Path) -> None:
    (folder / "mine").mkdir()
    (folder / "mine" / "design.json").write_text("mine")
    done = run_popsim(folder, *WORDS, "-o", "mine")
    assert done.returncode == 2
    assert "--force" in done.stderr
    assert contents(folder / "mine") == {Path("design.json"): b"mine"}


def test_the_usual_weights_are_those_of_fitting() -> None:
    said = inspect.signature(design).parameters["weights"].default
    assert parse_weights(said) == Weights()

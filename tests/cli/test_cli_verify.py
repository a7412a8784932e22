"""What `popsim verify` writes beside its table."""

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest
from folding_designs import overlapping_boxes, plain_box

from popsim.design import dump_design
from popsim.simulation import to_mjcf

OPTIONS = ["--junit", "--mjcf"]


@pytest.fixture
def box(tmp_path: Path) -> str:
    (tmp_path / "box.json").write_text(dump_design(plain_box()))
    return "box.json"


def test_all_files_are_written_also_for_what_fails(popsim, tmp_path: Path) -> None:
    (tmp_path / "cross.json").write_text(dump_design(overlapping_boxes()))
    done = popsim("verify", "cross.json", "--junit", "out.xml", "--mjcf", "out.mjcf.xml")
    assert done.returncode == 1, done.stderr
    suite = ElementTree.fromstring((tmp_path / "out.xml").read_text()).find("testsuite")
    assert suite.get("name") == "cross.json" and suite.get("failures") == "1"
    assert (tmp_path / "out.mjcf.xml").read_text() == to_mjcf(overlapping_boxes())


@pytest.mark.parametrize("option", OPTIONS)
def test_no_file_is_overwritten_without_force_and_none_written_before(
    popsim_main, tmp_path: Path, box: str, option: str
) -> None:
    (tmp_path / "kept").write_text("mine")
    done = popsim_main("verify", box, option, "kept", "--report", "verdict.json")
    assert done.returncode == 2 and "--force" in done.stderr
    assert (tmp_path / "kept").read_text() == "mine"
    assert not (tmp_path / "verdict.json").exists()
    assert popsim_main("verify", box, option, "kept", "--force").returncode == 0
    assert (tmp_path / "kept").read_text() != "mine"


def test_textures_that_are_not_there_are_told_and_change_no_verdict(popsim_main, tmp_path: Path) -> None:
    design = plain_box()
    textured = tuple(
        patch.model_copy(update={"texture": f"textures/{patch.id}.png"}) for patch in design.patches[:3]
    )
    data = dump_design(design.model_copy(update={"patches": (*textured, *design.patches[3:])}))
    (tmp_path / "box.json").write_text(data)
    done = popsim_main("verify", "box.json", "--report", "verdict.json")
    assert done.returncode == 0
    (note,) = json.loads((tmp_path / "verdict.json").read_text())["notes"]
    assert note.startswith(f"{textured[0].texture} and 2 more: no such file beside the design")
    (tmp_path / "textures").mkdir()
    for patch in textured:
        (tmp_path / patch.texture).touch()
    assert popsim_main("verify", "box.json", "--report", "verdict.json", "--force").returncode == 0
    assert json.loads((tmp_path / "verdict.json").read_text())["notes"] == []


def test_a_plot_is_drawn_and_its_format_checked_before_any_work(popsim_main, tmp_path: Path, box: str) -> None:
    assert popsim_main("verify", box, "--plot", "plot.svg").returncode == 0
    assert ElementTree.parse(tmp_path / "plot.svg").getroot().tag.endswith("svg")
    done = popsim_main("verify", box, "--plot", "plot.bmp", "--report", "verdict.json")
    assert done.returncode == 2 and ".svg" in done.stderr
    assert not (tmp_path / "verdict.json").exists()


def test_an_animation_of_another_format_is_refused_before_any_work(popsim_main, tmp_path: Path, box: str) -> None:
    done = popsim_main("verify", box, "--animate", "box.avi", "--report", "verdict.json")
    assert done.returncode == 2 and ".gif" in done.stderr
    assert not (tmp_path / "verdict.json").exists()


def test_paper_adds_its_own_table_report_and_csv(popsim_main, tmp_path: Path, box: str) -> None:
    done = popsim_main(
        "verify", box, "--paper", "200gsm", "--crease", "0.1", "--csv", "t.csv", "--report", "v.json"
    )
    assert done.returncode == 0, done.stderr
    assert "as paper" in done.stdout and "closed stack" in done.stdout
    assert json.loads((tmp_path / "v.json").read_text())["paper"]["stock"]["crease"] == 0.1
    assert (tmp_path / "t.csv").read_text().startswith("fold angle deg,")


@pytest.mark.parametrize(
    ("options", "word"),
    [
        (("--paper", "card"), "200gsm"),
        (("--paper", "200gsm", "--thickness", "thick"), "--thickness"),
        (("--paper", "200gsm", "--bending", "-3"), "bending"),
        (("--csv", "t.csv"), "--paper"),
        (("--crease", "0.2"), "--paper"),
    ],
)
def test_paper_that_makes_no_sense_is_refused_before_any_work(
    popsim_main, tmp_path: Path, box: str, options: tuple[str, ...], word: str
) -> None:
    done = popsim_main("verify", box, *options, "--report", "verdict.json")
    assert done.returncode == 2 and word in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "verdict.json").exists() and not (tmp_path / "t.csv").exists()

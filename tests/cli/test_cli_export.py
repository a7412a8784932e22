"""A design in one more format, from the command line."""

from pathlib import Path
from xml.etree import ElementTree

import pytest
import trimesh

from popsim.design import Card, dump_design
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold


@pytest.fixture
def design(tmp_path: Path) -> Path:
    card = Card(x=(-60, 60), depth=90)
    path = tmp_path / "design.json"
    path.write_text(dump_design(assemble(card, [BoxFold.plain("M1", card_pair(card), 20, 30, (-30, 30))])))
    return path


def test_sheets_and_solids_of_a_design(popsim_main, design: Path, tmp_path: Path) -> None:
    for words, files in (
        (("--format", "svg", "--paper", "Letter 300gsm"), ["design-1.svg"]),
        (("--format", "stl", "--angle", 90, "-o", "half.stl"), ["half.stl"]),
        (
            (
                "--format",
                "glb",
            ),
            ["design.glb"],
        ),
    ):
        done = popsim_main("export", design, *words)
        assert done.returncode == 0, done.stderr
        assert all((tmp_path / name).exists() for name in files)
        assert files[0] in done.stdout
    assert "score each crease" in (tmp_path / "design-1.svg").read_text()
    bounds = trimesh.load(tmp_path / "half.stl").bounds
    assert bounds[1, 2] == pytest.approx(90 * 0.5**0.5, abs=0.01)
    assert popsim_main("export", design, "--format", "glb").returncode == 2  # it exists
    assert popsim_main("export", design, "--format", "glb", "--force").returncode == 0


def test_the_format_is_that_of_the_file_to_be_written(popsim_main, design: Path, tmp_path: Path) -> None:
    done = popsim_main("export", design, "-o", "sheet.svg")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "sheet-1.svg").read_text().startswith("<?xml")
    assert popsim_main("export", design, "-o", "bare", "--format", "fold").returncode == 0
    assert {"bare.fold", "bare-M1-C.fold"} <= {path.name for path in tmp_path.iterdir()}
    done = popsim_main("export", design, "-o", "sheet.dxf", "--format", "svg")
    assert done.returncode == 2 and "named as dxf" in done.stderr


def test_the_sheet_says_with_which_options_it_was_made(popsim, design: Path, tmp_path: Path) -> None:
    options = ("--style", "mono", "--two-sided", "--grain", "--registration", "silhouette")
    assert popsim("export", design, "-o", "s.svg", *options).returncode == 0
    text = " ".join(ElementTree.parse(tmp_path / "s-1.svg").getroot().itertext())
    assert set(options) <= set(text.split())


def test_unknown_formats_are_refused_with_the_known(popsim_main, design: Path) -> None:
    done = popsim_main("export", design, "--format", "docx")
    assert done.returncode == 2
    assert "pdf" in done.stderr and "glb" in done.stderr


def test_a_design_too_large_for_its_sheet_is_refused_with_the_scale_that_fits(popsim_main, design: Path) -> None:
    done = popsim_main("export", design, "--paper", "50x70mm")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith("popsim: G measures 90.0 x 120.0 mm without flaps, more than the 34 x 36 mm")
    assert "scale the design by 0." in done.stderr
    assert "Traceback" not in done.stderr
    assert not design.with_suffix(".pdf").exists()
    assert popsim_main("export", design, "--paper", "120x130mm").returncode == 0

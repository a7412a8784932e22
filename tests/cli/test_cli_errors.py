"""Bad input: one clear line on stderr, exit code 2, nothing written."""

import json
from pathlib import Path

import pytest

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize(
    ("name", "content", "word"),
    [
        ("empty.obj", "", "empty"),
        ("letter.obj", "Dear Sir or Madam,\nwhere are my faces?\n", "face"),
        ("point.obj", "v 0 0 0\n", "face"),
        ("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""),
        ("model.docx", "hello", "docx"),
        ("flat.obj", TRIANGLE, ""),
        ("packed.gltf", '{"extensionsRequired": ["EXT_meshopt_compression"]}', "EXT_meshopt_compression"),
    ],
)
def test_what_is_no_model_is_named(popsim_main, tmp_path: Path, name: str, content: str, word: str) -> None:
    (tmp_path / name).write_text(content)
    done = popsim_main("design", name)
    assert done.returncode == 2, done.stdout + done.stderr
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith("popsim: ") and word in last
    assert "Traceback" not in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {name}


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (("design", "missing.obj"), "model missing.obj does not exist"),
        (("design", "m.obj", "--detail", 2), "detail"),
        (("design", "m.obj", "--size", "big"), "--size"),
        (("design", "m.obj", "--size", "3km"), "--size"),
        (("design", "m.obj", "--paper", "A17"), "A17"),
        (("design", "m.obj", "--style", "baroque"), "baroque"),
        (("calibration", "--paper", "A17"), "A17"),
        (("design", "m.obj", "--dpi", 5), "dpi"),
        (("design", "m.obj", "--format", "docx"), "docx"),
        (("design", "m.obj", "--registration", "moon"), "moon"),
        (("design", "m.obj", "--base", "grass"), "none, outline, print"),
        (("design", "m.obj", "--bleed", "wide"), "--bleed"),
        (("design", "m.obj", "--reverse", "loud"), "--reverse"),
        (("design", "m.obj", "--up", "w"), "up: 'w'"),
        (("design", "m.obj", "-o", "m.obj"), "file, not a folder"),
        (("verify", "missing.json"), "does not exist"),
        (("verify", "m.obj"), "JSON"),
        (("verify", "."), "folder"),
        (("nonsense",), "nonsense"),
    ],
)
def test_bad_arguments_are_named(popsim_main, tmp_path: Path, arguments: tuple[object, ...], word: str) -> None:
    (tmp_path / "m.obj").write_text(TRIANGLE)
    done = popsim_main(*arguments)
    assert done.returncode == 2, done.stdout + done.stderr
    assert word in done.stderr
    assert "Traceback" not in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"m.obj"}


def test_design_of_another_version_is_refused(popsim_main, tmp_path: Path) -> None:
    (tmp_path / "d.json").write_text(json.dumps({"format": "popsim-design", "version": 99, "unit": "mm"}))
    done = popsim_main("verify", "d.json")
    assert done.returncode == 2
    assert "version" in done.stderr and "99" in done.stderr


def test_unwritable_folder_is_named(popsim_main, tmp_path: Path) -> None:
    (tmp_path / "m.obj").write_text(TRIANGLE)
    done = popsim_main("design", "m.obj", "-o", "m.obj/out")
    assert done.returncode == 2
    assert "m.obj/out cannot be made" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--forbid", "pleat"), "--forbid: there is no mechanism 'pleat'"),
        (("--wishes", "none.yaml"), "wishes none.yaml does not exist"),
        (("--wishes", "w.yaml"), "w.yaml: keeep: extra inputs are not permitted"),
        (("--scale", "1:0"), "--scale: '1:0' is not a scale"),
        (("--scale", "1:2", "--size", "9cm"), "--size and --scale both say how large"),
        (("--card", "A12"), "paper 'A12' is not known"),
        (
            ("--align", "30"),
            "align: '30' is unknown; expected one of npca, edges, none, or an angle such as 30deg",
        ),
    ],
)
def test_the_users_hand_slips(popsim_main, tmp_path: Path, arguments: tuple[str, ...], words: str) -> None:
    (tmp_path / "m.obj").write_text(TRIANGLE)
    (tmp_path / "w.yaml").write_text("keeep: []")
    done = popsim_main("design", "m.obj", *arguments)
    assert done.returncode == 2, done.stdout + done.stderr
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "word"),
    [(("m.obj",), "empty"), (("m.obj", "--detail", "2"), "detail"), (("--dpi", "90"), "MODEL")],
)
def test_a_process_of_its_own_ends_likewise(popsim, tmp_path: Path, arguments: tuple[str, ...], word: str) -> None:
    """With a model that is none, a number out of range, and nothing to work on."""
    (tmp_path / "m.obj").touch()
    done = popsim("design", *arguments)
    assert done.returncode == 2, done.stdout + done.stderr
    assert word in done.stderr.splitlines()[-1]
    assert "Traceback" not in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"m.obj"}

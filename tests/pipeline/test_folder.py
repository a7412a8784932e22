"""Filling a folder again: what an earlier run made and this one did not is gone, all else stays."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from popsim.errors import OutputError
from popsim.pipeline.folder import REPORT, REPORT_FORMAT, fill_folder


def writing(*names: str, listed: tuple[str, ...] | None = None) -> Callable[[Path], list[Path]]:
    """What writes some files, and a report that lists them (or what is `listed`)."""

    def fill(folder: Path) -> list[Path]:
        for name in names:
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(name)
        report = {"format": REPORT_FORMAT, "files": [*(listed or names), REPORT]}
        (folder / REPORT).write_text(json.dumps(report))
        return [folder / name for name in (*names, REPORT)]

    return fill


def names(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_sheets_of_an_earlier_run_are_removed(tmp_path: Path) -> None:
    out = tmp_path / "out"
    fill_folder(out, writing("sheets-1.svg", "sheets-2.svg", "textures/a.png", "textures/b.png"), force=False)
    (out / "mine.txt").write_text("kept")
    made = fill_folder(out, writing("sheets-1.svg"), force=True)
    assert {path.name for path in made} == {"sheets-1.svg", REPORT}
    assert names(out) == {"sheets-1.svg", "mine.txt", REPORT}
    assert not (out / "textures").exists()


def test_without_force_nothing_is_touched(tmp_path: Path) -> None:
    fill_folder(tmp_path / "out", writing("a", "b"), force=False)
    with pytest.raises(OutputError, match="not empty"):
        fill_folder(tmp_path / "out", writing("a"), force=False)
    assert names(tmp_path / "out") == {"a", "b", REPORT}


def test_nothing_outside_the_folder_is_removed(tmp_path: Path) -> None:
    (tmp_path / "precious").write_text("kept")
    (tmp_path / "away").mkdir()
    (tmp_path / "away" / "c").write_text("kept")
    out = tmp_path / "out"
    listed = ("../precious", str(tmp_path / "precious"), "link/c")
    fill_folder(out, writing("a", listed=listed), force=False)
    (out / "link").symlink_to(tmp_path / "away")
    fill_folder(out, writing("a"), force=True)
    assert (tmp_path / "precious").exists()
    assert (tmp_path / "away" / "c").exists()


@pytest.mark.parametrize("report", ["no JSON", "[]", '{"format": "other", "files": ["a"]}', '{"format": 7}'])
def test_a_foreign_report_lists_nothing(tmp_path: Path, report: str) -> None:
    (tmp_path / "a").write_text("kept")
    (tmp_path / REPORT).write_text(report)
    fill_folder(tmp_path, writing("b"), force=True)
    assert names(tmp_path) == {"a", "b", REPORT}

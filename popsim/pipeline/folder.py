"""Filling a folder: with everything, or with nothing."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path, PurePosixPath

from popsim.errors import OutputError

REPORT, REPORT_FORMAT = "report.json", "popsim-report"
"""Name of the report of a run, and what it says that it is."""


def check_folder(folder: Path, force: bool) -> None:
    """Raise OutputError if `folder` cannot be filled: no folder, not writable, or not empty without `force`."""
    ground = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    if ground != folder.absolute() and not ground.is_dir():
        raise OutputError(f"{folder} cannot be made: {ground} is a file; choose another --output")
    if not os.access(ground, os.W_OK):
        raise OutputError(f"{folder} cannot be written: no permission for {ground}; choose another --output")
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file, not a folder; choose another name for --output")
    if folder.is_dir() and any(folder.iterdir()) and not force:
        raise OutputError(f"{folder} is not empty; choose another --output, empty it or add --force")


def fill_folder(folder: Path, fill: Callable[[Path], Iterable[Path]], *, force: bool) -> tuple[Path, ...]:
    """Let `fill` write files into a folder of its own, then move all that it returns into `folder`.

    What an earlier run says in its report that it made there, and this one did not make again, is removed.

    Returns
    -------
    The files where they stand now.

    Raises
    ------
    OutputError
        The folder is not empty and `force` is false, or cannot be written.
    """
    check_folder(folder, force)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".popsim-", dir=folder) as name:
            earlier, made = _listed(folder), list(fill(Path(name)))
            files = tuple(_moved(file, Path(name), folder) for file in made)
        _remove(earlier - set(files), folder)
        return files
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(
            f"{folder} cannot be written ({error.strerror or error}); choose another folder"
        ) from None


def _moved(file: Path, start: Path, folder: Path) -> Path:
    target = folder / file.relative_to(start)
    target.parent.mkdir(exist_ok=True)
    shutil.move(file, target)
    return target


def _listed(folder: Path) -> set[Path]:
    """The files that the report in a folder lists, as far as they are there; nothing outside the folder."""
    try:
        report = json.loads((folder / REPORT).read_bytes())
        names = report["files"] if report["format"] == REPORT_FORMAT else []
        inside = [folder / name for name in names if not {"..", ""} & set(PurePosixPath(name).parts)]
    except (OSError, ValueError, KeyError, TypeError):
        return set()
    return {path for path in inside if path.is_file() and path.resolve().is_relative_to(folder.resolve())}


def _remove(files: Iterable[Path], folder: Path) -> None:
    """Remove files, and folders that are empty then."""
    for file in files:
        file.unlink()
        if file.parent != folder and not any(file.parent.iterdir()):
            file.parent.rmdir()

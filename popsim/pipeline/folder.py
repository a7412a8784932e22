"""Filling a folder: with everything, or with nothing."""

import os
import shutil
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path

from popsim.errors import OutputError


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
            return tuple(_moved(file, Path(name), folder) for file in list(fill(Path(name))))
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

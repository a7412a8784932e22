"""Writing files whole or not at all, and never over a file of the user's without leave."""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from popsim.errors import InputError, OutputError


def read_bytes(path: Path, what: str) -> bytes:
    """Return the bytes of `path`; `what` names the thing in the error ("model", "design").

    Raises
    ------
    InputError
        The file is missing, a folder, or cannot be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{what} {path} does not exist; give the path of an existing file") from None
    except IsADirectoryError:
        raise InputError(f"{what} {path} is a folder; give the path of a file in it") from None
    except OSError as error:
        raise InputError(f"{what} {path} cannot be read ({error.strerror}); check its permissions") from None


def refuse_overwrite(path: Path, force: bool) -> None:
    """Raise OutputError if `path` exists and `force` is false."""
    if path.exists() and not force:
        raise OutputError(f"{path} exists and is not overwritten; remove it, choose another name or add --force")


def write_file(path: Path, write: Callable[[Path], object], *, force: bool) -> Path:
    """Let `write` fill a temporary file beside `path`, then rename it to `path`.

    Parameters
    ----------
    path:
        Where the file shall stand; its folder is made if it is missing.
    write:
        Called with the temporary path (which has the suffix of `path`).
    force:
        Overwrite an existing file.

    Raises
    ------
    OutputError
        The file exists and `force` is false, or the folder cannot be written.
    """
    refuse_overwrite(path, force)
    temporary: Path | None = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        temporary = Path(name)
        write(temporary)
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        reason = error.strerror or str(error)
        raise OutputError(f"{path} cannot be written ({reason}); choose a folder that can be written to") from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)
    return path


def write_bytes(path: Path, content: bytes, *, force: bool) -> Path:
    """Write `content` to `path` as :func:`write_file` does."""
    return write_file(path, lambda temporary: temporary.write_bytes(content), force=force)


def write_text(path: Path, content: str, *, force: bool) -> Path:
    """Write `content` to `path` in UTF-8 as :func:`write_file` does."""
    return write_bytes(path, content.encode(), force=force)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask

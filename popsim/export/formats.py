"""Formats by name. A new one is a function in a file of its own and one row of the table."""

from collections.abc import Callable
from pathlib import Path

from popsim.errors import InputError
from popsim.export.pdf import write_pdf
from popsim.export.styles import Style
from popsim.export.svg import write_svg
from popsim.layout.sheet import Sheet

Writer = Callable[[tuple[Sheet, ...], Path, Style, Path, str], tuple[Path, ...]]
"""Sheets, path, style, folder of the textures, title; returns the files written."""

FORMATS: dict[str, Writer] = {"pdf": write_pdf, "svg": write_svg}


def find_writer(name: str) -> Writer:
    """Return the writer of the format called `name`.

    Raises
    ------
    InputError
        There is none; the message lists them.
    """
    if name not in FORMATS:
        raise InputError(f"format {name!r} is not known; give {', '.join(FORMATS)}")
    return FORMATS[name]

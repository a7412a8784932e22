"""Formats by name. A new one is a function in a file of its own and one row of the table."""

from collections.abc import Callable
from pathlib import Path

from popsim.errors import InputError
from popsim.export.dxf import write_dxf
from popsim.export.fold import write_fold
from popsim.export.job import Job
from popsim.export.pdf import write_pdf
from popsim.export.svg import write_svg

Writer = Callable[[Job, Path], tuple[Path, ...]]
"""Writes a job to a path, or to one file per sheet beside it; returns the files written."""

FORMATS: dict[str, Writer] = {"pdf": write_pdf, "svg": write_svg, "dxf": write_dxf, "fold": write_fold}


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

"""Exporting a layout: its sheets in one of the formats."""

import shutil
import tempfile
from functools import lru_cache, partial
from pathlib import Path

from popsim.assembly import AssemblyPlan
from popsim.errors import OutputError
from popsim.export.formats import Writer, find_writer
from popsim.export.job import Job
from popsim.export.printing import Printing
from popsim.export.styles import find_style
from popsim.files import refuse_overwrite, write_file
from popsim.layout import Layout, draw_sheets
from popsim.layout.sheet import Sheet
from popsim.simulation import Sweep


def export(
    layout: Layout,
    path: Path,
    format: str,
    *,
    texture_root: Path,
    printing: Printing | None = None,
    plan: AssemblyPlan | None = None,
    sweep: Sweep | None = None,
    force: bool = False,
) -> tuple[Path, ...]:
    """Write the sheets of a layout; the same input gives the same bytes.

    Parameters
    ----------
    path:
        The file. Formats with one sheet per file put "-1", "-1-reverse", "-2" ... or "-notes" before its suffix.
    format:
        A name in :data:`popsim.export.formats.FORMATS`.
    texture_root:
        The folder that the textures' paths are relative to: that of the design file.
    printing:
        Line style, texts and sides; None for the usual.
    plan:
        Prints its numbers instead of the layout's own.
    sweep:
        The motion of the design, for formats that show it.
    force:
        Overwrite existing files.

    Returns
    -------
    The files written.

    Raises
    ------
    InputError
        The format or style is unknown, or a texture cannot be read.
    OutputError
        A file exists, or the folder cannot be written.
    """
    printing = printing or Printing()
    writer, style = find_writer(format), find_style(printing.style)
    layout = layout if plan is None else plan.layout
    job = Job(layout, _sheets(layout, printing), style, texture_root, path.stem, sweep)
    return _written(writer, job, path, force)


@lru_cache(maxsize=1)
def _sheets(layout: Layout, printing: Printing) -> tuple[Sheet, ...]:
    """The sheets of a layout, drawn once for all formats."""
    return draw_sheets(
        layout,
        footer=printing.footer,
        banner=printing.banner,
        two_sided=printing.two_sided,
        notes=printing.notes,
    )


def _written(writer: Writer, job: Job, path: Path, force: bool) -> tuple[Path, ...]:
    """Write a job aside, then put all of its files where they belong, or none."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            made = writer(job, Path(folder) / path.name)
            targets = [path.with_name(file.name) for file in made]
            for target in targets:
                refuse_overwrite(target, force)
            for file, target in zip(made, targets, strict=True):
                write_file(target, partial(shutil.copyfile, file), force=force)
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(f"{path} cannot be written ({error.strerror or error}); choose another folder") from None
    return tuple(targets)

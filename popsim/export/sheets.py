"""Exporting a layout: its sheets in one of the formats."""

import shutil
import tempfile
from functools import partial
from pathlib import Path

from popsim.assembly import AssemblyPlan, draw_steps
from popsim.errors import OutputError
from popsim.export.formats import find_writer
from popsim.export.job import Job
from popsim.export.styles import find_style
from popsim.files import refuse_overwrite, write_file
from popsim.layout import Layout, draw_sheets
from popsim.simulation import Sweep


def export(
    layout: Layout,
    path: Path,
    format: str,
    *,
    texture_root: Path,
    style: str = "origami",
    footer: str = "",
    banner: str | None = None,
    plan: AssemblyPlan | None = None,
    two_sided: bool = False,
    notes: tuple[str, ...] = (),
    sweep: Sweep | None = None,
    force: bool = False,
) -> tuple[Path, ...]:
    """Write the sheets of a layout; the same input gives the same bytes.

    Parameters
    ----------
    path:
        The file. Formats with one sheet per file put "-1", "-2" ... before its suffix.
    format:
        A name in :data:`popsim.export.formats.FORMATS`.
    texture_root:
        The folder that the textures' paths are relative to: that of the design file.
    style:
        A name in :data:`popsim.export.styles.STYLES`.
    footer:
        What reproduces the sheets: command, version, seed, input hash.
    banner:
        A warning on every sheet, or None.
    plan:
        Prints its numbers instead of the layout's own, and its steps after the sheets.
    two_sided:
        Follow each sheet by its mirrored reverse.
    notes:
        What to check, on the last sheet where there is room, else on one more.
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
    writer, look = find_writer(format), find_style(style)
    layout = layout if plan is None else plan.layout
    sheets = draw_sheets(layout, footer=footer, banner=banner, two_sided=two_sided, notes=notes)
    if plan is not None:
        sheets += draw_steps(plan)
    try:
        with tempfile.TemporaryDirectory() as folder:
            made = writer(Job(layout, sheets, look, texture_root, path.stem, sweep), Path(folder) / path.name)
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

"""Writing the folder that a run leaves behind."""

import json
import os
import shutil
import tempfile
from pathlib import Path

from popsim.assembly import plan_assembly
from popsim.design import dump_design
from popsim.errors import OutputError
from popsim.export import export
from popsim.layout import lay_out
from popsim.pipeline.report import report_of
from popsim.pipeline.run import DesignRun

UNVERIFIED = "NOT VERIFIED: this design failed the folding test"

REPORT = "report.json"


def deliver(run: DesignRun, folder: Path, *, command: str, footer: str, force: bool) -> tuple[Path, ...]:
    """Write design, textures, sheets, assembly steps and report; all of them, or nothing.

    A design that failed verification is not exported: only its report is written, unless the settings allow it.

    Returns
    -------
    The files written.

    Raises
    ------
    OutputError
        A file exists and `force` is false, or the folder cannot be written.
    """
    check_folder(folder, force)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".popsim-", dir=folder) as name:
            made = _fill(run, Path(name), command, footer)
            return tuple(_moved(file, Path(name), folder) for file in made)
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(
            f"{folder} cannot be written ({error.strerror or error}); choose another folder"
        ) from None


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


def _fill(run: DesignRun, folder: Path, command: str, footer: str) -> list[Path]:
    """Write everything into a folder of its own; the files, the report last."""
    made: list[Path] = []
    layout = None
    if run.verdict.passed or run.settings.allow_unverified:
        for name, content in run.painted.images.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
            made.append(folder / name)
        (folder / "design.json").write_text(dump_design(run.design))
        made.append(folder / "design.json")
        plan = plan_assembly(lay_out(run.design, paper=run.settings.paper, settings=run.settings.layout))
        layout = plan.layout
        banner = None if run.verdict.passed else UNVERIFIED
        for kind in run.settings.formats:
            made += export(
                layout,
                folder / f"sheets.{kind}",
                kind,
                texture_root=folder,
                style=run.settings.style,
                footer=footer,
                banner=banner,
                plan=plan,
                two_sided=run.settings.two_sided,
            )
        (folder / "assembly.md").write_text(plan.text)
        made.append(folder / "assembly.md")
    report = json.dumps(report_of(run, layout, command), indent=1, allow_nan=False)
    (folder / REPORT).write_text(report + "\n")
    return [*made, folder / REPORT]


def _moved(file: Path, start: Path, folder: Path) -> Path:
    target = folder / file.relative_to(start)
    target.parent.mkdir(exist_ok=True)
    shutil.move(file, target)
    return target

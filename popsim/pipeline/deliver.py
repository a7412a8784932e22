"""Writing the folder that a run leaves behind."""

import json
from pathlib import Path

from popsim.pipeline.folder import fill_folder
from popsim.pipeline.prints import write_prints
from popsim.pipeline.report import report_of
from popsim.pipeline.run import DesignRun

UNVERIFIED = "NOT VERIFIED: this design failed the folding test"

REPORT = "report.json"


def deliver(run: DesignRun, folder: Path, *, command: str, footer: str, force: bool) -> tuple[Path, ...]:
    """Write design, textures, sheets, booklet, assembly steps and report; all of them, or nothing.

    A design that failed verification is not exported: only its report is written, unless the settings allow it.

    Returns
    -------
    The files written.

    Raises
    ------
    OutputError
        A file exists and `force` is false, or the folder cannot be written.
    """
    return fill_folder(folder, lambda own: _fill(run, own, command, footer), force=force)


def _fill(run: DesignRun, folder: Path, command: str, footer: str) -> list[Path]:
    """Write everything into a folder of its own; the files, the report last."""
    made: list[Path] = []
    layout = None
    if run.verdict.passed or run.settings.allow_unverified:
        for name, content in run.painted.images.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
            made.append(folder / name)
        banner = None if run.verdict.passed else UNVERIFIED
        title = run.prepared.model.path.stem
        plan, prints = write_prints(run.design, folder, run.settings, name=title, footer=footer, banner=banner)
        layout = plan.layout
        made += prints
    report = json.dumps(report_of(run, layout, command), indent=1, allow_nan=False)
    (folder / REPORT).write_text(report + "\n")
    return [*made, folder / REPORT]

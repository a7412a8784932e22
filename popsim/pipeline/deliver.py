"""Writing the folder that a run leaves behind."""

import json
from pathlib import Path
from typing import NamedTuple

from popsim.design import Source
from popsim.pipeline.folder import REPORT, fill_folder
from popsim.pipeline.planned import Planned, plan_sheets
from popsim.pipeline.prints import write_prints
from popsim.pipeline.report import report_of
from popsim.pipeline.review import bare_sides
from popsim.pipeline.run import DesignRun
from popsim.pipeline.wishes import wishes_text

UNVERIFIED = "NOT VERIFIED: this design failed the folding test"

WISHES = "wishes.yaml"


class Delivery(NamedTuple):
    """What was written, and what was planned; None for what failed its verification."""

    files: tuple[Path, ...]
    planned: Planned | None


def deliver(run: DesignRun, folder: Path, *, command: str, footer: str, force: bool) -> Delivery:
    """Plan a run and write design, textures, sheets, booklet, steps, wishes and report; all of them, or nothing.

    A design that failed verification is not exported, unless the settings allow it: only its wishes and its
    report are written.

    Returns
    -------
    The files written, and what was planned.

    Raises
    ------
    OutputError
        A file exists and `force` is false, or the folder cannot be written.
    """
    planned = None
    if run.verdict.passed or run.settings.allow_unverified:
        sweep = run.verdict.evidence.sweep
        planned = plan_sheets(run.design, sweep, paper=run.settings.paper, settings=run.settings.layout)
    files = fill_folder(folder, lambda own: _fill(run, planned, own, command, footer), force=force)
    return Delivery(files, planned)


def _fill(run: DesignRun, planned: Planned | None, folder: Path, command: str, footer: str) -> list[Path]:
    """Write everything into a folder of its own; the files, the report last."""
    made: list[Path] = []
    if planned is not None:
        for name, content in run.painted.images.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
            made.append(folder / name)
        banner = None if run.verdict.passed else UNVERIFIED
        title = run.prepared.model.path.stem
        sweep = run.verdict.evidence.sweep
        made += write_prints(
            planned,
            run.design,
            sweep,
            folder,
            run.settings,
            name=title,
            footer=footer,
            banner=banner,
            checks=bare_sides(run.painted.fins, run.settings.patches.reverse),
        )
    (folder / WISHES).write_text(_wishes(run, command))
    files = [*made, folder / WISHES, folder / REPORT]
    names = [file.relative_to(folder).as_posix() for file in files]
    report = json.dumps(report_of(run, planned, names, command), indent=1, allow_nan=False)
    (folder / REPORT).write_text(report + "\n")
    return files


def _wishes(run: DesignRun, command: str) -> str:
    model = run.prepared.model
    return wishes_text(
        run.fit.mechanisms,
        size=run.prepared.longest,
        most_patches=run.settings.fit.most_patches,
        source=Source(file=model.path.name, sha256=model.sha256),
        command=command,
    )

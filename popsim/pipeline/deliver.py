"""Writing the folder that a run leaves behind."""

import json
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

from popsim.booklet import begun_picture
from popsim.design import Source
from popsim.errors import OutputError
from popsim.geometry.arrays import UInt8Array
from popsim.pipeline.calibration import calibration_design, write_calibration
from popsim.pipeline.folder import REPORT, fill_folder
from popsim.pipeline.planned import Planned, plan_sheets
from popsim.pipeline.prints import write_prints
from popsim.pipeline.report import report_of
from popsim.pipeline.review import bare_sides
from popsim.pipeline.run import DesignRun, Progress
from popsim.pipeline.wishes import wishes_text
from popsim.verification import verify

UNVERIFIED = "NOT VERIFIED: this design failed the folding test"

WISHES = "wishes.yaml"

CALIBRATION = "calibration"
"""The folder of the test build within that of a design."""


class Delivery(NamedTuple):
    """What was written, and what was planned; None for what failed its verification."""

    files: tuple[Path, ...]
    planned: Planned | None


def deliver(
    run: DesignRun,
    folder: Path,
    *,
    command: str,
    footer: str,
    force: bool,
    progress: Progress = lambda stage: None,
) -> Delivery:
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
    planned, fill = None, partial(_wishes_and_report, run, None, command)
    if run.verdict.passed or run.settings.allow_unverified:
        sweep = run.verdict.evidence.sweep
        progress("planning sheets and assembly")
        picture = begun_picture(run.design, run.painted.images)
        planned = plan_sheets(run.design, sweep, paper=run.settings.paper, settings=run.settings.layout)
        fill = partial(_everything, run, planned, picture, command, footer)
        progress("drawing sheets and booklet")
    return Delivery(fill_folder(folder, fill, force=force), planned)


def _everything(
    run: DesignRun, planned: Planned, picture: Callable[[], UInt8Array], command: str, footer: str, folder: Path
) -> list[Path]:
    """Write all files into a folder of its own; the report is the last."""
    made: list[Path] = []
    for name, content in run.painted.images.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(content)
        made.append(folder / name)
    made += write_prints(
        planned,
        run.design,
        run.verdict.evidence.sweep,
        picture,
        folder,
        run.settings,
        name=run.prepared.model.path.stem,
        footer=footer,
        banner=None if run.verdict.passed else UNVERIFIED,
        checks=bare_sides(run.painted.fins, run.settings.patches.reverse),
    )
    if run.settings.calibration:
        made += _test_build(run, folder / CALIBRATION, footer)
    return made + _wishes_and_report(run, planned, command, folder, made)


def _wishes_and_report(
    run: DesignRun, planned: Planned | None, command: str, folder: Path, made: Sequence[Path] = ()
) -> list[Path]:
    """Write the wishes, and the report on these and on the files `made` before."""
    (folder / WISHES).write_text(_wishes(run, command))
    files = [folder / WISHES, folder / REPORT]
    names = [file.relative_to(folder).as_posix() for file in (*made, *files)]
    report = json.dumps(report_of(run, planned, names, command), indent=1, allow_nan=False)
    (folder / REPORT).write_text(report + "\n")
    return files


def _test_build(run: DesignRun, folder: Path, footer: str) -> list[Path]:
    """Verify the test build and write it as its own command does."""
    verdict = verify(calibration_design())
    if not verdict.passed:
        raise OutputError(f"{folder.name} is not written: the test build does not fold")
    folder.mkdir()
    return write_calibration(verdict.evidence.sweep, folder, run.settings, footer=footer)


def _wishes(run: DesignRun, command: str) -> str:
    model = run.prepared.model
    return wishes_text(
        run.fit.mechanisms,
        size=run.prepared.longest,
        fold=run.prepared.alignment.fold,
        most_patches=run.settings.fit.most_patches,
        source=Source(file=model.path.name, sha256=model.sha256),
        command=command,
    )

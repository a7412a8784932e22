"""`popsim calibration`."""

from pathlib import Path
from typing import Annotated

import typer

from popsim.cli.options import ForceFolder, Formats, Paper, Style, chosen_formats


def calibration(
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to write.")] = Path("calibration"),
    paper: Paper = "A4",
    style: Style = "origami",
    format: Formats = None,
    force: ForceFolder = False,
) -> None:
    """Print a test build, a small box and a small wedge on a card: try printer, paper, knife and glue on it first.

    Exit code 0: folded in MuJoCo as the theory says, and written. 1: it does not fold.
    """
    from popsim import __version__
    from popsim.cli.table import print_verdict
    from popsim.layout import LayoutSettings
    from popsim.pipeline import RunSettings
    from popsim.pipeline.calibration import NAME, calibration_design, deliver_calibration
    from popsim.pipeline.folder import check_folder
    from popsim.stock import split_stock
    from popsim.verification import verify

    stock, sheet = split_stock(paper)
    settings = RunSettings(
        paper=sheet or "A4",
        style=style,
        layout=LayoutSettings(stock=stock),
        formats=chosen_formats(format),
    )
    settings.check_choices()
    check_folder(output, force)
    verdict = verify(calibration_design())
    print_verdict(verdict, NAME)
    if verdict.passed:
        footer = f"popsim {__version__} · popsim calibration --paper '{paper}' --style {style}"
        files = deliver_calibration(verdict.evidence.sweep, output, settings, footer=footer, force=force)
        typer.echo(f"{len(files)} files in {output}")
    raise typer.Exit(0 if verdict.passed else 1)

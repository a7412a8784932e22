"""`popsim calibration`."""

from pathlib import Path
from typing import Annotated

import typer


def calibration(
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to write.")] = Path("calibration"),
    paper: Annotated[
        str, typer.Option(help='Sheet (A4, Letter, 300x400mm), weight (200gsm) or both ("Letter 160gsm").')
    ] = "A4",
    style: Annotated[str, typer.Option(help="Line style of the sheet.")] = "origami",
    format: Annotated[
        list[str] | None, typer.Option(help="pdf, svg, dxf or fold; may be repeated. By default pdf and svg.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Write into a folder that is not empty.")] = False,
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
        formats=tuple(dict.fromkeys(format or ("pdf", "svg"))),
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

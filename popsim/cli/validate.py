"""`popsim validate`."""

from pathlib import Path
from typing import Annotated

import typer


def validate(
    count: Annotated[int, typer.Option(help="Number of random designs.")] = 300,
    seed: Annotated[int, typer.Option(help="From which they are drawn.")] = 0,
    jobs: Annotated[int, typer.Option(help="Processes; -1 takes one for each core.")] = -1,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FOLDER", help="Write disagreements and report here."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Write into a folder that is not empty.")] = False,
) -> None:
    """Confirm the geometric conditions over random designs, valid and with exactly one condition broken.

    Exit code 0: theory and simulation disagree nowhere, but for slack. 1: they do; the designs are written.
    """
    import json

    from rich.console import Console
    from rich.progress import Progress

    from popsim.files import write_text
    from popsim.pipeline.folder import check_folder
    from popsim.verification.campaign import run_campaign, summary

    if output is not None:
        check_folder(output, force)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("folding", total=count)
        campaign = run_campaign(count, seed, jobs, folder=output, progress=lambda outcome: bar.advance(task))
    found = campaign.to_dict()
    if output is not None:
        write_text(output / "report.json", json.dumps(found, indent=1) + "\n", force=force)
        write_text(output / "summary.txt", summary(found), force=force)
    typer.echo(summary(found), nl=False)
    raise typer.Exit(0 if campaign.passed else 1)

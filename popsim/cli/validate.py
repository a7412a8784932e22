"""`popsim validate`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from popsim.verification.campaign import Campaign


def validate(
    count: Annotated[int, typer.Option(help="Number of random designs.")] = 300,
    seed: Annotated[int, typer.Option(help="From which they are drawn.")] = 0,
    jobs: Annotated[int, typer.Option(help="Processes; -1 takes one for each core.")] = -1,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FOLDER", help="Write disagreements and report here.")
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
    from popsim.verification.campaign import run_campaign

    if output is not None:
        check_folder(output, force)
    console = Console(highlight=False)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("folding", total=count)
        campaign = run_campaign(count, seed, jobs, folder=output, progress=lambda outcome: bar.advance(task))
    if output is not None:
        write_text(output / "report.json", json.dumps(campaign.to_dict(), indent=1) + "\n", force=force)
    _print(campaign, console)
    raise typer.Exit(0 if campaign.passed else 1)


def _print(campaign: "Campaign", console: "Console") -> None:
    """Confusion matrices, reasons, residuals, disagreements, and the line that counts."""
    from rich import box
    from rich.table import Table

    words = {True: "passes", False: "refuses", None: "-"}
    table = Table("aspect", "theory", "simulation", "designs", box=box.SIMPLE_HEAD, pad_edge=False)
    for aspect, matrix in campaign.matrices.items():
        for (theory, simulation), designs in sorted(matrix.items(), key=str, reverse=True):
            table.add_row(aspect, words[theory], words[simulation], str(designs))
    console.print(table)
    reasons = Table("planted flaw", "refused because of", "designs", box=box.SIMPLE_HEAD, pad_edge=False)
    for flaw, counted in sorted(campaign.refusals.items()):
        for reason, designs in sorted(counted.items()):
            reasons.add_row(flaw, reason or "not refused", str(designs))
    console.print(reasons)
    residuals = Table("largest over the valid designs", "value", "design", box=box.SIMPLE_HEAD, pad_edge=False)
    for name, residual in sorted(campaign.residuals.items()):
        residuals.add_row(name, f"{residual.value:.3g}", str(residual.index))
    console.print(residuals)
    for outcome, each in campaign.disagreements:
        console.print(f"design {outcome.task.index}: {each}", markup=False)
    patches = sum(outcome.patches for outcome in campaign.outcomes)
    word = "[bold green]PASSED[/]" if campaign.passed else "[bold red]FAILED[/]"
    found = len(campaign.disagreements)
    console.print(
        f"{word} {campaign.count} designs, {patches} patches, seed {campaign.seed}: {found} disagreements"
    )

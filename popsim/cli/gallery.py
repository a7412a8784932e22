"""`popsim gallery`."""

from pathlib import Path
from typing import Annotated

import typer


def gallery(
    places: Annotated[list[Path], typer.Argument(metavar="MODEL...", help="Models, or folders with models.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="PNG or JPEG to write.")],
    columns: Annotated[int, typer.Option(help="Models side by side.")] = 3,
    jobs: Annotated[int, typer.Option(help="Processes; -1 takes one for each core.")] = -1,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing picture.")] = False,
) -> None:
    """Draw many models beside their open pop-ups, in the same view, on one sheet.

    Exit code 0: each has a pop-up. 1: some have none, see the last lines. 2: something is wrong with the input.
    """
    from PIL import Image
    from rich.console import Console
    from rich.progress import Progress

    from popsim.files import refuse_overwrite, write_file
    from popsim.pictures.picture_file import save_options
    from popsim.pipeline.gallery import exhibits, find_models, hang

    options = save_options(output)
    refuse_overwrite(output, force)
    models = find_models(places)
    shown = []
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("designing", total=len(models))
        for each in exhibits(models, jobs):
            shown.append(each)
            bar.advance(task)
    sheet = Image.fromarray(hang(shown, columns)).convert("RGB")
    write_file(output, lambda temporary: sheet.save(temporary, **options), force=force)
    missing = [each for each in shown if each.picture is None]
    for each in missing:
        typer.echo(f"no pop-up of {each.caption}", err=True)
    typer.echo(f"{len(shown) - len(missing)} of {len(shown)} models in {output}")
    raise typer.Exit(1 if missing else 0)

"""`popsim render`."""

from pathlib import Path
from typing import Annotated

import typer


def render(
    path: Annotated[Path, typer.Argument(metavar="DESIGN", help="A design.json.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="PNG or JPEG to write.")],
    angle: Annotated[list[float], typer.Option(help="Fold angle in degrees; may be repeated.")] = [180.0],  # noqa: B006  # typer copies it
    model: Annotated[Path | None, typer.Option(help="Draw the model beside it.")] = None,
    sheet: Annotated[Path | None, typer.Option(help="Draw the first page of this PDF too.")] = None,
    azimuth: Annotated[
        list[float],
        typer.Option(help="View from this side, degrees; 0 is the front. May be repeated, for more rows."),
    ] = [35.0],  # noqa: B006  # typer copies it
    elevation: Annotated[float, typer.Option(help="View from this height, degrees.")] = 25.0,
    width: Annotated[int, typer.Option(help="Of each picture, pixels.")] = 640,
    height: Annotated[int, typer.Option(help="Of each picture, pixels.")] = 480,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing picture.")] = False,
) -> None:
    """Draw the pop-up at some fold angles, beside its model if you like."""
    from PIL import Image

    from popsim.design import load_design
    from popsim.files import refuse_overwrite, write_file
    from popsim.pictures import Look, picture_strip
    from popsim.pictures.picture_file import save_options

    options = save_options(output)
    refuse_overwrite(output, force)
    looks = [Look(side, elevation, width, height) for side in azimuth]
    strip = picture_strip(load_design(path), path.parent, angle, looks=looks, model=model, sheet=sheet)
    picture = Image.fromarray(strip).convert("RGB")
    write_file(output, lambda temporary: picture.save(temporary, **options), force=force)

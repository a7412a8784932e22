"""`popsim export`."""

from pathlib import Path
from typing import Annotated

import typer

from popsim.cli.options import Grain, Paper, Registration, Style, TwoSided, printed_words


def export(
    path: Annotated[Path, typer.Argument(metavar="DESIGN", help="A design.json, of popsim or anybody else.")],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="By default DESIGN's name and the format."),
    ] = None,
    format: Annotated[
        str | None,
        typer.Option(help="pdf, svg, dxf, fold: sheets. glb, obj, stl: the pop-up. By default FILE's, or pdf."),
    ] = None,
    angle: Annotated[
        float | None, typer.Option(help="Fold angle of the pop-up, degrees; GLB moves if none is given.")
    ] = None,
    paper: Paper = "A4",
    style: Style = "origami",
    two_sided: TwoSided = False,
    grain: Grain = False,
    registration: Registration = "none",
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.")] = False,
) -> None:
    """Write a design in one more format: its sheets, or the pop-up in space at any fold angle.

    Nothing is verified; popsim verify does that.
    """
    from popsim import __version__
    from popsim.design import load_design
    from popsim.export import FORMATS, Printing
    from popsim.export.solid import SOLIDS, export_solid
    from popsim.layout import LayoutSettings
    from popsim.pipeline.planned import export_sheets
    from popsim.stock import split_stock

    format = _format(format, output, (*FORMATS, *SOLIDS))
    design = load_design(path)
    target = output or path
    target = target if output and target.suffix else target.with_suffix(f".{format}")
    if format in SOLIDS:
        made = export_solid(design, target, format, textures=path.parent, angle=angle, force=force)
    else:
        stock, sheet = split_stock(paper)
        words = ["popsim export", path.name, f"--format {format}", f"--paper '{paper}'"]
        words += printed_words(style, two_sided=two_sided, grain=grain, registration=registration)
        settings = LayoutSettings(grain=grain, registration=registration, stock=stock)
        made = export_sheets(
            design,
            target,
            format,
            textures=path.parent,
            paper=sheet or "A4",
            settings=settings,
            printing=Printing(
                style,
                two_sided,
                f"popsim {__version__} · {' '.join(words)}",
            ),
            force=force,
        )
    typer.echo("\n".join(str(file) for file in made))


def _format(name: str | None, output: Path | None, known: tuple[str, ...]) -> str:
    """The format that is asked for by its name or by the file's; they must agree."""
    from popsim.errors import InputError

    suffix = "" if output is None else output.suffix.removeprefix(".").lower()
    chosen = name or suffix or "pdf"
    if chosen not in known:
        raise InputError(f"format {chosen!r} is not known; give {', '.join(known)}")
    if suffix in known and suffix != chosen:
        raise InputError(f"{output} is named as {suffix}, but the format is {chosen}; give one of the two")
    return chosen

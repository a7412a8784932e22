"""`popsim verify`."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from popsim.design import Design
    from popsim.stock import Stock
    from popsim.verification import Verdict

MOVING = "Draw the card closing and opening; GIF, WebP, APNG or MP4."
STOCK = "Fold it as paper too, e.g. 200gsm or '200gsm 0.25mm': torque, stack, sag, clearance."


def verify(
    path: Annotated[Path, typer.Argument(metavar="DESIGN", help="A design.json, of popsim or anybody else.")],
    report: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the JSON report here.")] = None,
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the verdict as JUnit XML.")] = None,
    mjcf: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the model for MuJoCo's viewer.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw what was measured; PNG or SVG.")] = None,
    animate: Annotated[Path | None, typer.Option(metavar="FILE", help=MOVING)] = None,
    paper: Annotated[str | None, typer.Option(metavar="STOCK", help=STOCK)] = None,
    thickness: Annotated[str | None, typer.Option(help="Of that paper, e.g. 0.25mm.")] = None,
    bending: Annotated[float | None, typer.Option(help="Its bending stiffness per width, N mm.")] = None,
    crease: Annotated[float | None, typer.Option(help="Its crease stiffness per length, N mm/rad per mm.")] = None,
    csv: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write torque and clearance of --paper.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.")] = False,
) -> None:
    """Fold a design in MuJoCo and compare what is measured with the theory.

    Exit code 0: it folds. 1: it does not, or theory and simulation contradict each other. 2: it is no design.
    """
    from popsim.cli.table import print_verdict
    from popsim.design import load_design
    from popsim.files import refuse_overwrite, write_text
    from popsim.simulation import to_mjcf
    from popsim.verification import verify as fold_and_judge
    from popsim.verification.paper_report import paper_csv

    design = load_design(path)
    stock = _stock(paper, thickness=thickness, bending=bending, crease=crease, csv=csv)
    for wanted in (report, junit, mjcf, plot, animate, csv):
        if wanted is not None:
            refuse_overwrite(wanted, force)
    drawings = list(_drawings(path, plot, animate, force))
    verdict = fold_and_judge(design, stock=stock, beside=_beside(design, path.parent))
    texts = (
        (report, verdict.to_json),
        (junit, lambda: verdict.to_junit(str(path))),
        (mjcf, lambda: to_mjcf(design)),
        (csv, lambda: paper_csv(verdict.paper)),
    )
    for file, text in texts:
        if file is not None:
            write_text(file, text(), force=force)
    for draw in drawings:
        draw(design, verdict)
    print_verdict(verdict, str(path))
    raise typer.Exit(0 if verdict.passed else 1)


def _beside(design: "Design", folder: Path) -> tuple[str, ...]:
    """What is to be said of the files beside a design: textures that are missing, which folding does not need."""
    from popsim.design import missing_textures

    missing = missing_textures(design, folder)
    if not missing:
        return ()
    more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
    return (f"{missing[0]}{more}: no such file beside the design; folding needs none, but pictures and sheets do",)


def _drawings(
    path: Path, plot: Path | None, animate: Path | None, force: bool
) -> Iterator[Callable[["Design", "Verdict"], None]]:
    """What draws the pictures that are asked for; their imports would take as long as a small design.

    Raises
    ------
    InputError
        A file cannot be of the format that its name says.
    """
    if plot is not None:
        from popsim.pictures.plot import check_plot, write_plot

        check_plot(plot)
        yield lambda design, verdict: write_plot(plot, design, verdict, str(path), force=force)
    if animate is not None:
        from popsim.pictures.animation import check_animation, write_animation

        check_animation(animate)
        yield lambda design, verdict: write_animation(animate, design, verdict, path.parent, force=force)


def _stock(
    paper: str | None, *, thickness: str | None, bending: float | None, crease: float | None, csv: Path | None
) -> "Stock | None":
    """The stock of `--paper`, with what is said of it beside.

    Raises
    ------
    InputError
        It is no stock, or something is said of a paper that is not given.
    """
    from popsim.errors import InputError
    from popsim.stock import parse_stock
    from popsim.units import parse_length

    beside = {"--thickness": thickness, "--bending": bending, "--crease": crease, "--csv": csv}
    if paper is None:
        alone = [name for name, value in beside.items() if value is not None]
        if alone:
            raise InputError(f"{alone[0]} goes with a paper; add --paper, for example --paper 200gsm")
        return None
    thick = None if thickness is None else parse_length(thickness, "--thickness")
    return parse_stock(paper, thickness=thick, bending=bending, crease=crease)

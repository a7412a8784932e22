"""`popsim verify`."""

from pathlib import Path
from typing import Annotated

import typer


def verify(
    path: Annotated[Path, typer.Argument(metavar="DESIGN", help="A design.json, of popsim or anybody else.")],
    report: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the JSON report here.")] = None,
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the verdict as JUnit XML.")] = None,
    mjcf: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the model for MuJoCo's viewer.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw what was measured; PNG or SVG.")] = None,
    animate: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the card closing and opening; GIF, WebP or APNG.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.")] = False,
) -> None:
    """Fold a design in MuJoCo and compare what is measured with the theory.

    Exit code 0: it folds. 1: it does not, or theory and simulation contradict each other. 2: it is no design.
    """
    from popsim.cli.table import print_verdict
    from popsim.design import load_design
    from popsim.files import refuse_overwrite, write_text
    from popsim.pictures.animation import check_animation, write_animation
    from popsim.pictures.plot import check_plot, write_plot
    from popsim.simulation import to_mjcf
    from popsim.verification import verify as fold_and_judge

    design = load_design(path)
    for wanted in (report, junit, mjcf, plot, animate):
        if wanted is not None:
            refuse_overwrite(wanted, force)
    if plot is not None:
        check_plot(plot)
    if animate is not None:
        check_animation(animate)
    verdict = fold_and_judge(design)
    if report is not None:
        write_text(report, verdict.to_json(), force=force)
    if junit is not None:
        write_text(junit, verdict.to_junit(str(path)), force=force)
    if mjcf is not None:
        write_text(mjcf, to_mjcf(design), force=force)
    if plot is not None:
        write_plot(plot, design, verdict, str(path), force=force)
    if animate is not None:
        write_animation(animate, design, verdict, path.parent, force=force)
    print_verdict(verdict, str(path))
    raise typer.Exit(0 if verdict.passed else 1)

"""`popsim verify`."""

from pathlib import Path
from typing import Annotated

import typer


def verify(
    path: Annotated[Path, typer.Argument(metavar="DESIGN", help="A design.json, of popsim or anybody else.")],
    report: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the JSON report here.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing report.")] = False,
) -> None:
    """Fold a design in MuJoCo and compare what is measured with the theory.

    Exit code 0: it folds. 1: it does not, or theory and simulation contradict each other. 2: it is no design.
    """
    from popsim.cli.table import print_verdict
    from popsim.design import load_design
    from popsim.files import refuse_overwrite, write_text
    from popsim.verification import verify as fold_and_judge

    design = load_design(path)
    if report is not None:
        refuse_overwrite(report, force)
    verdict = fold_and_judge(design)
    if report is not None:
        write_text(report, verdict.to_json(), force=force)
    print_verdict(verdict, str(path))
    raise typer.Exit(0 if verdict.passed else 1)

"""`popsim design`."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from popsim import wording
from popsim.cli.options import (
    ForceFolder,
    Formats,
    Grain,
    Paper,
    Registration,
    Style,
    TwoSided,
    chosen_formats,
    printed_words,
)

if TYPE_CHECKING:
    from popsim.patches import PatchSettings
    from popsim.pipeline import DesignRun, RunSettings

SPARE = 0.5
"""mm by which pictures are larger than what is shown of them: nothing ends at the border of an image."""


class Fold(StrEnum):
    """Along which side the central fold runs."""

    AUTO, LONG, SHORT = "auto", "long", "short"


Model = Annotated[Path, typer.Argument(metavar="MODEL", help="OBJ, STL, PLY, OFF, GLB, glTF or 3MF.")]
Folder = Annotated[
    Path | None, typer.Option("--output", "-o", help="Folder to write; by default MODEL's name and -popup.")
]
Up = Annotated[
    str, typer.Option(metavar="DIRECTION", help="What points up: x, -x, y, -y, z, -z, or a vector as 0.2,0,1.")
]
Front = Annotated[str | None, typer.Option(metavar="DIRECTION", help="What points to the front, likewise.")]
Align = Annotated[
    str,
    typer.Option(
        metavar="npca|edges|none|ANGLE",
        help="Heading by normals, by long edges, as it is, or turned from there by an angle as 30deg.",
    ),
]
FoldSide = Annotated[Fold, typer.Option(help="Side along which the central fold runs.")]
Size = Annotated[
    str | None, typer.Option(help="Longest side of the model, e.g. 120mm; by default what the paper allows.")
]
Scale = Annotated[str | None, typer.Option(help="Or its scale, as 1:87; units are mm, in glTF metres.")]
Card = Annotated[
    str | None, typer.Option(help="The card when folded, as A5 or 180x120mm; the model is made to fit.")
]
Wishes = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="What to keep, forbid and pin; each run writes such a file."),
]
Forbid = Annotated[
    list[str] | None, typer.Option(metavar="MECHANISM", help="Never use it, as v-fold-1; may be repeated.")
]
Detail = Annotated[float, typer.Option(help="0: few patches, 1: many.")]
Weights = Annotated[
    str, typer.Option(metavar="W1,W2,W3", help="Of outliers, distance and coverage in Eq. 1; they add up to 1.")
]
MaxPatches = Annotated[int | None, typer.Option(help="Never make more patches.", show_default="120")]
Dpi = Annotated[float, typer.Option(help="Resolution of the prints.")]
Base = Annotated[str, typer.Option(help="What the pages show: none, outline or print.")]
Bleed = Annotated[str, typer.Option(help="How far prints reach beyond cuts and folds.")]
Reverse = Annotated[
    str | None, typer.Option(metavar="COLOUR", help="Of the side of the paper that is not printed.")
]
Seed = Annotated[int, typer.Option(help="Of everything random; the report states it.")]
Unverified = Annotated[
    bool, typer.Option("--allow-unverified", help="Export even what does not fold, every sheet marked.")
]
TestBuild = Annotated[
    bool, typer.Option("--calibration", help="Print the test build too, as `popsim calibration` does.")
]


def design(
    model: Model,
    output: Folder = None,
    up: Up = "auto",
    front: Front = None,
    align: Align = "npca",
    fold: FoldSide = Fold.AUTO,
    size: Size = None,
    scale: Scale = None,
    card: Card = None,
    wishes: Wishes = None,
    forbid: Forbid = None,
    detail: Detail = 0.5,
    weights: Weights = "0.5,0.3,0.2",
    max_patches: MaxPatches = None,
    paper: Paper = "A4",
    style: Style = "origami",
    format: Formats = None,
    two_sided: TwoSided = False,
    grain: Grain = False,
    registration: Registration = "none",
    dpi: Dpi = 300.0,
    base: Base = "outline",
    bleed: Bleed = "1mm",
    reverse: Reverse = None,
    seed: Seed = 0,
    allow_unverified: Unverified = False,
    calibration: TestBuild = False,
    force: ForceFolder = False,
) -> None:
    """Design a pop-up of a 3D model, fold it in MuJoCo, and export its sheets if it passes.

    Exit code 0: designed and verified. 1: it does not fold, see the report. 2: something is wrong with the input.
    """
    from popsim.cli.choices import chosen_fold, chosen_size, chosen_wishes, most_patches, parse_weights, read_hand
    from popsim.fitting import FitSettings
    from popsim.layout import LayoutSettings
    from popsim.pipeline import RunSettings, Stance
    from popsim.stock import split_stock
    from popsim.units import parse_length

    bled = parse_length(bleed, "--bleed")
    stock, sheet = split_stock(paper)
    hand = read_hand(wishes)
    chosen, exact = chosen_size(size, scale, hand)
    settings = RunSettings(
        stance=Stance(up, front, align, chosen_fold(fold.value, hand)),
        fit=FitSettings(
            detail, most_patches(max_patches, hand), parse_weights(weights), chosen_wishes(hand, forbid or ())
        ),
        patches=_prints(dpi, base, bled, reverse),
        size=chosen,
        exact_size=exact,
        card=card,
        wishes_for=hand.sha256,
        paper=sheet or "A4",
        style=style,
        layout=LayoutSettings(grain=grain, registration=registration, bleed=bled, stock=stock),
        two_sided=two_sided,
        formats=chosen_formats(format),
        seed=seed,
        allow_unverified=allow_unverified,
        calibration=calibration,
    )
    raise typer.Exit(0 if _designed(model, settings, wishes, output, force) else 1)


def _prints(dpi: float, base: str, bleed: float, reverse: str | None) -> "PatchSettings":
    from popsim.patches import PatchSettings
    from popsim.units import parse_colour

    behind = None if reverse is None else parse_colour(reverse, "--reverse")
    return PatchSettings(dpi=dpi, base=base, bleed=bleed + SPARE, reverse=behind)


def _designed(model: Path, settings: "RunSettings", wishes: Path | None, output: Path | None, force: bool) -> bool:
    """Design, deliver and tell; returns whether it passed."""
    from popsim.cli.table import print_verdict
    from popsim.pipeline.complete import complete
    from popsim.pipeline.folder import check_folder

    folder = output or Path(f"{model.stem}-popup")
    settings.check_choices()
    check_folder(folder, force)
    command = _command(model, settings, wishes)
    run, (files, planned) = complete(
        model,
        settings,
        folder,
        command=command,
        footer=lambda run: _footer(run, command),
        force=force,
        progress=lambda stage: typer.echo(f"{stage} ...", err=True),
    )
    print_verdict(run.verdict, model.name)
    kinds = ", ".join(f"{m.mechanism.id} {m.mechanism.type}" for m in run.fit.placements)
    typer.echo(f"{len(run.design.popup_patches)} patches: {kinds}")
    for doubt in run.doubts:
        typer.echo(doubt)
    if planned is not None:
        if planned.layout.divided:
            typer.echo(wording.DIVIDED.format(patches=wording.listed(list(planned.layout.divided))))
        typer.echo(f"to be made in {planned.plan.ease}")
        for problem in planned.unproved:
            typer.echo(problem)
    typer.echo(f"{len(files)} files in {folder}")
    return run.verdict.passed


def _command(model: Path, settings: "RunSettings", wishes: Path | None) -> str:
    """The options that reproduce a run, without the folder it was written to."""
    stance = settings.stance
    words = ["popsim design", model.name, f"--up {stance.up}", f"--align {stance.align}", f"--fold {stance.fold}"]
    if stance.front:
        words.append(f"--front {stance.front}")
    if settings.exact_size:
        number = settings.size
        words.append(f"--size {number:g}mm" if isinstance(number, float) else f"--scale {number}")
    if settings.card:
        words.append(f"--card '{settings.card}'")
    if wishes:
        words.append(f"--wishes {wishes.name}")
    words += [f"--forbid {name}" for name in sorted(settings.fit.wishes.forbidden)]
    words += [f"--detail {settings.fit.detail:g}", f"--max-patches {settings.fit.most_patches}"]
    words.append(f"--weights {settings.fit.weights}")
    words += [f"--base {settings.patches.base}", f"--bleed {settings.layout.bleed:g}mm"]
    if settings.patches.reverse:
        words.append(f"--reverse '{settings.patches.reverse}'")
    paper = " ".join([settings.paper, *([settings.layout.stock.name] if settings.layout.stock else [])])
    words += [f"--paper '{paper}'", f"--dpi {settings.patches.dpi:g}", f"--seed {settings.seed}"]
    words += printed_words(
        settings.style,
        two_sided=settings.two_sided,
        grain=settings.layout.grain,
        registration=settings.layout.registration,
    )
    if settings.calibration:
        words.append("--calibration")
    return " ".join(words)


def _footer(run: "DesignRun", command: str) -> str:
    from popsim import __version__

    return f"popsim {__version__} · {command} · input sha256 {run.prepared.model.sha256[:16]}"

"""`popsim design`."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from popsim.pipeline import DesignRun, RunSettings


SPARE = 0.5
"""mm by which pictures are larger than what is shown of them: nothing ends at the border of an image."""


class Fold(StrEnum):
    """Along which side the central fold runs."""

    AUTO, LONG, SHORT = "auto", "long", "short"


def design(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="OBJ, STL, PLY, OFF, GLB, glTF or 3MF.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to write; by default MODEL's name and -popup.")
    ] = None,
    up: Annotated[
        str, typer.Option(metavar="DIRECTION", help="What points up: x, -x, y, -y, z, -z, or a vector as 0.2,0,1.")
    ] = "auto",
    front: Annotated[
        str | None,
        typer.Option(metavar="DIRECTION", help="What points to the front, likewise."),
    ] = None,
    align: Annotated[
        str,
        typer.Option(
            metavar="npca|edges|none|ANGLE",
            help="Heading by normals, by long edges, as it is, or turned from there by an angle as 30deg.",
        ),
    ] = "npca",
    fold: Annotated[Fold, typer.Option(help="Side along which the central fold runs.")] = Fold.AUTO,
    size: Annotated[
        str | None, typer.Option(help="Longest side of the model, e.g. 120mm; by default what the paper allows.")
    ] = None,
    scale: Annotated[str | None, typer.Option(help="Or its scale, as 1:87; units are mm, in glTF metres.")] = None,
    card: Annotated[
        str | None, typer.Option(help="The card when folded, as A5 or 180x120mm; the model is made to fit.")
    ] = None,
    wishes: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="What to keep, forbid and pin; each run writes such a file."),
    ] = None,
    forbid: Annotated[
        list[str] | None, typer.Option(metavar="MECHANISM", help="Never use it, as v-fold-1; may be repeated.")
    ] = None,
    detail: Annotated[float, typer.Option(help="0: few patches, 1: many.")] = 0.5,
    max_patches: Annotated[int | None, typer.Option(help="Never make more patches.", show_default="120")] = None,
    paper: Annotated[
        str, typer.Option(help='Sheet (A4, Letter, 300x400mm), weight (200gsm) or both ("Letter 160gsm").')
    ] = "A4",
    style: Annotated[str, typer.Option(help="Line style of the sheets.")] = "origami",
    format: Annotated[
        list[str] | None, typer.Option(help="pdf, svg, dxf or fold; may be repeated. By default pdf and svg.")
    ] = None,
    two_sided: Annotated[bool, typer.Option("--two-sided", help="Mirrored sheets for the back.")] = False,
    grain: Annotated[bool, typer.Option("--grain", help="Keep the direction of the paper's grain.")] = False,
    registration: Annotated[
        str, typer.Option(help="Marks and limits of a cutting machine: none, silhouette or cricut.")
    ] = "none",
    dpi: Annotated[float, typer.Option(help="Resolution of the prints.")] = 300.0,
    base: Annotated[str, typer.Option(help="What the pages show: none, outline or print.")] = "outline",
    bleed: Annotated[str, typer.Option(help="How far prints reach beyond cuts and folds.")] = "1mm",
    reverse: Annotated[
        str | None, typer.Option(metavar="COLOUR", help="Of the side of the paper that is not printed.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of everything random; the report states it.")] = 0,
    allow_unverified: Annotated[
        bool, typer.Option("--allow-unverified", help="Export even what does not fold, every sheet marked.")
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Write into a folder that is not empty.")] = False,
) -> None:
    """Design a pop-up of a 3D model, fold it in MuJoCo, and export its sheets if it passes.

    Exit code 0: designed and verified. 1: it does not fold, see the report. 2: something is wrong with the input.
    """
    from popsim.cli.choices import chosen_size, chosen_wishes, most_patches
    from popsim.cli.table import print_verdict
    from popsim.fitting import FitSettings
    from popsim.layout import LayoutSettings
    from popsim.patches import PatchSettings
    from popsim.pipeline import RunSettings, run_design
    from popsim.pipeline.deliver import deliver
    from popsim.pipeline.folder import check_folder
    from popsim.pipeline.prepare import Stance
    from popsim.pipeline.wishes import Hand, load_wishes
    from popsim.stock import split_stock
    from popsim.units import parse_colour, parse_length

    bled = parse_length(bleed, "--bleed")
    behind = None if reverse is None else parse_colour(reverse, "--reverse")
    folder = output or Path(f"{model.stem}-popup")
    stock, sheet = split_stock(paper)
    hand = Hand() if wishes is None else load_wishes(wishes)
    chosen, exact = chosen_size(size, scale, hand)
    settings = RunSettings(
        stance=Stance(up, front, align, fold.value),
        fit=FitSettings(detail, most_patches(max_patches, hand), chosen_wishes(hand, forbid or ())),
        patches=PatchSettings(dpi=dpi, base=base, bleed=bled + SPARE, reverse=behind),
        size=chosen,
        exact_size=exact,
        card=card,
        wishes_for=hand.sha256,
        paper=sheet or "A4",
        style=style,
        layout=LayoutSettings(grain=grain, registration=registration, bleed=bled, stock=stock),
        two_sided=two_sided,
        formats=tuple(dict.fromkeys(format or ("pdf", "svg"))),
        seed=seed,
        allow_unverified=allow_unverified,
    )
    settings.check_choices()
    check_folder(folder, force)
    run = run_design(model, settings, lambda stage: typer.echo(f"{stage} ...", err=True))
    command = _command(model, settings, wishes)
    files = deliver(run, folder, command=command, footer=_footer(run, command), force=force)
    print_verdict(run.verdict, model.name)
    kinds = ", ".join(f"{m.mechanism.id} {m.mechanism.type}" for m in run.fit.placements)
    typer.echo(f"{len(run.design.popup_patches)} patches: {kinds}")
    for doubt in run.doubts:
        typer.echo(doubt)
    typer.echo(f"{len(files)} files in {folder}")
    raise typer.Exit(0 if run.verdict.passed else 1)


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
    words += [f"--base {settings.patches.base}", f"--bleed {settings.layout.bleed:g}mm"]
    if settings.patches.reverse:
        words.append(f"--reverse '{settings.patches.reverse}'")
    paper = " ".join([settings.paper, *([settings.layout.stock.name] if settings.layout.stock else [])])
    words += [f"--paper '{paper}'", f"--dpi {settings.patches.dpi:g}", f"--seed {settings.seed}"]
    return " ".join(words)


def _footer(run: "DesignRun", command: str) -> str:
    from popsim import __version__

    return f"popsim {__version__} · {command} · input sha256 {run.prepared.model.sha256[:16]}"

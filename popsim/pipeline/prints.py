"""What is printed of a design: sheets, booklet, steps in words."""

from collections.abc import Callable
from pathlib import Path

from popsim.booklet import begun_booklet, booklet_format, write_booklet
from popsim.design import Design, dump_design
from popsim.export import Printing, export
from popsim.geometry.arrays import UInt8Array
from popsim.pipeline.planned import Planned
from popsim.pipeline.settings import RunSettings
from popsim.simulation import Sweep


def write_prints(
    planned: Planned,
    design: Design,
    sweep: Sweep,
    picture: Callable[[], UInt8Array],
    folder: Path,
    settings: RunSettings,
    *,
    name: str,
    footer: str,
    banner: str | None = None,
    checks: tuple[str, ...] = (),
) -> list[Path]:
    """Write design, sheets, booklet and steps into a folder that has the textures of the design.

    Parameters
    ----------
    planned:
        Its layout and its assembly.
    design:
        What is printed.
    sweep:
        The recorded motion of the design.
    picture:
        That of the cover; see :func:`popsim.booklet.begun_picture`.
    name:
        Of the model, on the cover.
    footer:
        What reproduces it, on every sheet.
    banner:
        A warning on every sheet and on the cover, or None.
    checks:
        What to look at, on the last sheet and at the end of the booklet.

    Returns
    -------
    The files written.
    """
    plan, checks = planned.plan, (*checks, *planned.notes)
    printing = Printing(settings.style, settings.two_sided, footer, banner, checks)
    form = booklet_format(plan.layout.paper)
    booklet = begun_booklet(plan, sweep, form, name=name, banner=banner, checks=checks)
    made = [folder / "design.json"]
    made[0].write_text(dump_design(design))
    for kind in settings.formats:
        made += export(
            plan.layout,
            folder / f"sheets.{kind}",
            kind,
            texture_root=folder,
            printing=printing,
            plan=plan,
            sweep=sweep,
        )
    made += write_booklet(booklet, picture, form, folder)
    made.append(folder / "assembly.md")
    made[-1].write_text(plan.text)
    return made

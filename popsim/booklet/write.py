"""Writing the booklet beside the sheets."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.assembly import AssemblyPlan
from popsim.beside import Beside
from popsim.booklet.booklet import Booklet, make_booklet
from popsim.booklet.format import Format
from popsim.booklet.html import page_of
from popsim.booklet.inks import STYLE
from popsim.booklet.pages import draw_pages
from popsim.design import Design
from popsim.export.pdf import write_pages
from popsim.geometry.arrays import UInt8Array
from popsim.simulation import Sweep

if TYPE_CHECKING:
    from popsim.patches.popup_surface import Textures

NAME = "instructions"
PICTURE = "popup.png"


SIZE = 480, 360
"""Of the picture, in pixels."""


def started_picture(design: Design, textures: "Textures") -> Beside[UInt8Array]:
    """Begin to draw the cover picture, in a second process where there can be one.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    from popsim.pictures import Look, open_shot

    return Beside(open_shot(design, textures, Look(width=SIZE[0], height=SIZE[1])).take)


def started_booklet(
    plan: AssemblyPlan,
    sweep: Sweep,
    form: Format,
    *,
    name: str,
    banner: str | None = None,
    checks: tuple[str, ...] = (),
) -> Beside[Booklet]:
    """Begin to draw the figures of a booklet, in a second process where there can be one.

    Parameters
    ----------
    plan:
        The steps, with their scenes.
    sweep:
        The recorded motion of what is built.
    form:
        Of the pages.
    name:
        Of the model.
    banner:
        A warning on the cover, or None.
    checks:
        What to look at when it is done, one sentence each.
    """
    aspect = SIZE[0] / SIZE[1]
    return Beside(lambda: make_booklet(plan, sweep, name, PICTURE, aspect, form, banner, checks))


def write_booklet(
    booklet: Callable[[], Booklet], picture: Callable[[], UInt8Array], form: Format, folder: Path
) -> tuple[Path, ...]:
    """Write `popup.png`, `instructions.pdf` and `instructions.html`; the same input gives the same bytes.

    Parameters
    ----------
    booklet:
        Asked for when the picture is drawn; see :func:`started_booklet`.
    picture:
        That of the cover, RGBA; see :func:`started_picture`.
    form:
        Of the pages.
    folder:
        Where the textures of the design are, and where the files go; existing ones are overwritten.

    Returns
    -------
    The files written.
    """
    from PIL import Image

    cover, pdf, html = (folder / file for file in (PICTURE, f"{NAME}.pdf", f"{NAME}.html"))
    Image.fromarray(picture()).save(cover, format="PNG")
    content = booklet()
    title = f"{content.name}: {NAME}"
    write_pages(draw_pages(content, form), pdf, style=STYLE, texture_root=folder, title=title)
    html.write_text(page_of(content, folder), encoding="utf-8")
    return cover, pdf, html

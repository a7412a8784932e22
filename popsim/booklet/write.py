"""Writing the booklet beside the sheets."""

from collections.abc import Callable
from pathlib import Path

from popsim.assembly import AssemblyPlan
from popsim.beside import Beside
from popsim.booklet.booklet import Booklet, make_booklet
from popsim.booklet.format import Format
from popsim.booklet.html import page_of
from popsim.booklet.inks import STYLE
from popsim.booklet.pages import draw_pages
from popsim.design import Design
from popsim.export.pdf import write_pages
from popsim.simulation import Sweep

NAME = "instructions"
PICTURE = "popup.png"


SIZE = 480, 360
"""Of the picture, in pixels."""


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


def write_booklet(booklet: Callable[[], Booklet], design: Design, form: Format, folder: Path) -> tuple[Path, ...]:
    """Write `popup.png`, `instructions.pdf` and `instructions.html`; the same input gives the same bytes.

    Parameters
    ----------
    booklet:
        Asked for when the picture is drawn; see :func:`started_booklet`.
    design:
        What is built.
    form:
        Of the pages.
    folder:
        Where the textures of the design are, and where the files go; existing ones are overwritten.

    Returns
    -------
    The files written.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    from PIL import Image

    from popsim.pictures import Look, open_picture

    picture, pdf, html = (folder / file for file in (PICTURE, f"{NAME}.pdf", f"{NAME}.html"))
    look = Look(width=SIZE[0], height=SIZE[1])
    Image.fromarray(open_picture(design, folder, look)).save(picture, format="PNG")
    content = booklet()
    title = f"{content.name}: {NAME}"
    write_pages(draw_pages(content, form), pdf, style=STYLE, texture_root=folder, title=title)
    html.write_text(page_of(content, folder), encoding="utf-8")
    return picture, pdf, html

"""Writing the booklet beside the sheets."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.beside import begun
from popsim.booklet.booklet import PICTURE, SIZE, Booklet
from popsim.booklet.format import Format
from popsim.booklet.html import page_of
from popsim.booklet.inks import STYLE
from popsim.booklet.pages import draw_pages
from popsim.design import Design
from popsim.export.pdf import write_pages
from popsim.geometry.arrays import UInt8Array

if TYPE_CHECKING:
    from popsim.patches.popup_surface import Textures

NAME = "instructions"


def begun_picture(design: Design, textures: "Textures") -> Callable[[], UInt8Array]:
    """Begin to draw the cover picture, in a second process where there can be one; called, return it.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    from popsim.pictures import Look, open_shot

    shot = open_shot(design, textures, Look(width=SIZE[0], height=SIZE[1]))
    taken = begun(lambda own: own.take(), [shot])
    return lambda: taken()[0]


def write_booklet(
    booklet: Callable[[], Booklet], picture: Callable[[], UInt8Array], form: Format, folder: Path
) -> tuple[Path, ...]:
    """Write `popup.png`, `instructions.pdf` and `instructions.html`; the same input gives the same bytes.

    Parameters
    ----------
    booklet:
        Asked for when the picture is drawn; see :func:`popsim.booklet.booklet.begun_booklet`.
    picture:
        That of the cover, RGBA; see :func:`begun_picture`.
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
    page = begun(lambda own: page_of(own, folder), [content])
    title = f"{content.name}: {NAME}"
    write_pages(draw_pages(content, form), pdf, style=STYLE, texture_root=folder, title=title)
    html.write_text(page()[0], encoding="utf-8")
    return cover, pdf, html

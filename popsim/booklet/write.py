"""Writing the booklet beside the sheets."""

from pathlib import Path

from popsim.assembly import AssemblyPlan
from popsim.booklet.booklet import make_booklet
from popsim.booklet.format import booklet_format
from popsim.booklet.html import page_of
from popsim.booklet.inks import STYLE
from popsim.booklet.pages import draw_pages
from popsim.design import Design
from popsim.export.pdf import write_pages
from popsim.simulation import Sweep

NAME = "instructions"
PICTURE = "popup.png"


def write_booklet(
    plan: AssemblyPlan,
    design: Design,
    sweep: Sweep,
    folder: Path,
    *,
    name: str,
    banner: str | None = None,
    checks: tuple[str, ...] = (),
) -> tuple[Path, ...]:
    """Write `popup.png`, `instructions.pdf` and `instructions.html`; the same input gives the same bytes.

    Parameters
    ----------
    plan:
        The steps, with their scenes.
    design, sweep:
        What is built, and its recorded motion.
    folder:
        Where the textures of the design are, and where the files go; existing ones are overwritten.
    name:
        Of the model.
    banner:
        A warning on the cover, or None.
    checks:
        What to look at when it is done, one sentence each.

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

    look = Look(width=480, height=360)
    picture, pdf, html = (folder / file for file in (PICTURE, f"{NAME}.pdf", f"{NAME}.html"))
    Image.fromarray(open_picture(design, folder, look)).save(picture, format="PNG")
    form = booklet_format(plan.layout.paper)
    booklet = make_booklet(plan, sweep, name, PICTURE, look.width / look.height, form, banner, checks)
    write_pages(draw_pages(booklet, form), pdf, style=STYLE, texture_root=folder, title=f"{name}: {NAME}")
    html.write_text(page_of(booklet, folder), encoding="utf-8")
    return picture, pdf, html

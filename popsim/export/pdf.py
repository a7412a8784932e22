"""PDF of sheets at true scale, one page each; the only place that imports reportlab."""

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from popsim.export.job import Job
from popsim.export.styles import WHITE, Style
from popsim.export.textures import packed_texture
from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import HALO, Area, Line, Mark, Picture, Sheet, Text

POINTS = 72 / 25.4
"""Points in a millimetre."""

NUMBER = "%.3f"
"""How coordinates are written, points: to a third of a thousandth of a millimetre."""

FONT, BOLD = "Vera", "VeraBd"
"""Bitstream Vera Sans comes with reportlab and is embedded, so that every printer shows the same."""


FILL, OUTLINE = 0, 1
"""How PDF renders letters."""

ROUND = 1
"""How PDF joins lines."""


def write_pdf(job: Job, path: Path) -> tuple[Path, ...]:
    """Write all sheets into one file; the same sheets give the same bytes."""
    write_pages(job.sheets, path, style=job.style, texture_root=job.texture_root, title=job.title)
    return (path,)


def write_pages(pages: tuple[Sheet, ...], path: Path, *, style: Style, texture_root: Path, title: str) -> None:
    """Write pages of any drawing into one file; the same pages give the same bytes."""
    from reportlab import rl_config
    from reportlab.pdfgen.canvas import Canvas

    rl_config.useA85 = 0  # bytes as they are: letters for them take a quarter more, and most of the time
    _register_fonts()
    canvas = Canvas(str(path), invariant=1, pageCompression=1, initialFontName="Helvetica")
    canvas.setTitle(title)
    canvas.setCreator("popsim")
    canvas.setViewerPreference("PrintScaling", "None")
    for sheet in pages:
        canvas.setPageSize((sheet.width * POINTS, sheet.height * POINTS))
        for mark in sheet.marks:
            _draw(canvas, mark, style, texture_root)
        canvas.showPage()
    canvas.save()


def _register_fonts() -> None:
    from reportlab.pdfbase.pdfmetrics import getRegisteredFontNames, registerFont
    from reportlab.pdfbase.ttfonts import TTFont

    for name in (FONT, BOLD):
        if name not in getRegisteredFontNames():
            registerFont(TTFont(name, f"{name}.ttf"))


def _draw(canvas: Any, mark: Mark, style: Style, texture_root: Path) -> None:
    canvas.saveState()
    match mark:
        case Line():
            stroke = style.stroke(mark.looks or mark.role)
            canvas.setStrokeColorRGB(*stroke.colour)
            canvas.setLineWidth(stroke.width * POINTS)
            canvas.setDash([dash * POINTS for dash in stroke.dashes])
            canvas.drawPath(_path((mark.points,), mark.closed), stroke=1, fill=0)
        case Area():
            canvas.setFillColorRGB(*style.stroke(mark.looks or mark.role).colour)
            canvas.drawPath(_path(mark.rings), stroke=0, fill=1, fillMode=0)
        case Text():
            _text(canvas, mark, style)
        case Picture():
            canvas.clipPath(_path(mark.clip), stroke=0, fill=0, fillMode=0)
            _picture(canvas, mark, texture_root)
    canvas.restoreState()


def _path(rings: tuple[FloatArray, ...], closed: bool = True) -> Any:
    """A path from ring to ring; reportlab writes number by number, which takes as long as all else on a page."""
    from reportlab.pdfgen.pathobject import PDFPathObject

    words = ["n"]
    for ring in rings:
        form = " ".join([f"{NUMBER} {NUMBER} m"] + [f"{NUMBER} {NUMBER} l"] * (len(ring) - 1))
        words += [form % tuple((ring * POINTS).ravel().tolist()), "h" * closed]
    return PDFPathObject(words)


def _text(canvas: Any, mark: Text, style: Style) -> None:
    canvas.setFillColorRGB(*style.stroke(mark.role).colour)
    canvas.setFont(BOLD if mark.bold else FONT, mark.size * POINTS)
    canvas.translate(*(mark.at * POINTS))
    canvas.rotate(float(np.degrees(mark.angle)))
    draw = {"start": canvas.drawString, "middle": canvas.drawCentredString, "end": canvas.drawRightString}
    if mark.halo:
        canvas.setStrokeColorRGB(*WHITE)
        canvas.setLineWidth(HALO * mark.size * POINTS)
        canvas.setLineJoin(ROUND)
        draw[mark.anchor](0, 0, mark.text, mode=OUTLINE)
    draw[mark.anchor](0, 0, mark.text, mode=FILL)


def _picture(canvas: Any, mark: Picture, texture_root: Path) -> None:
    from reportlab.lib.utils import ImageReader

    frame = mark.frame.copy()
    frame[:2] *= POINTS
    canvas.transform(frame[0, 0], frame[1, 0], frame[0, 1], frame[1, 1], frame[0, 2], frame[1, 2])
    content, _ = packed_texture(texture_root, mark.image)
    canvas.drawImage(ImageReader(BytesIO(content)), 0, 0, 1, 1)

"""Several pictures with captions on one sheet, for galleries."""

from collections.abc import Callable, Sequence

import numpy as np

from popsim.errors import InputError
from popsim.geometry.arrays import UInt8Array

GAP = 16  # pixels around each picture
CAPTION = 18  # height of the letters in pixels
INK = (60, 60, 60, 255)
SHEET = (255, 255, 255, 255)


def contact_sheet(pictures: Sequence[UInt8Array], captions: Sequence[str], columns: int) -> UInt8Array:
    """Return one white RGBA image, shape (h, w, 4), of pictures in rows, each above its caption.

    Parameters
    ----------
    pictures:
        RGBA, shape (h_i, w_i, 4), centred in equal cells; transparent parts show the white sheet.
    captions:
        One per picture; cut with an ellipsis where wider than the cell.
    columns:
        Pictures in a row.

    Raises
    ------
    InputError
        There is no picture, the numbers of pictures and captions differ, or a picture is not RGBA.
    """
    from PIL import Image, ImageDraw, ImageFont

    if not pictures or len(pictures) != len(captions) or columns < 1:
        raise InputError(
            f"a contact sheet needs pictures, a caption for each and a column; found {len(pictures)} pictures, "
            f"{len(captions)} captions and {columns} columns"
        )
    for picture in pictures:
        if picture.ndim != 3 or picture.shape[2] != 4 or picture.dtype != np.uint8:
            raise InputError(f"pictures must be RGBA, shape (h, w, 4), 8 bits; found {picture.shape}")
    height, width = (max(picture.shape[axis] for picture in pictures) for axis in (0, 1))
    below = 2 * CAPTION
    rows = -(-len(pictures) // columns)
    columns = min(columns, len(pictures))
    size = (columns * (width + GAP) + GAP, rows * (height + below + GAP) + GAP)
    sheet = Image.new("RGBA", size, SHEET)
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(CAPTION)
    for index, (picture, caption) in enumerate(zip(pictures, captions, strict=True)):
        row, column = divmod(index, columns)
        left, top = GAP + column * (width + GAP), GAP + row * (height + below + GAP)
        offset = (left + (width - picture.shape[1]) // 2, top + (height - picture.shape[0]) // 2)
        sheet.alpha_composite(Image.fromarray(np.ascontiguousarray(picture)), offset)
        text = _shortened(caption, lambda words: draw.textlength(words, font=font), width)
        draw.text((left + width / 2, top + height + below / 2), text, INK, font, anchor="mm")
    return np.asarray(sheet)


def _shortened(caption: str, length: Callable[[str], float], width: float) -> str:
    if length(caption) <= width:
        return caption
    while caption and length(caption + "…") > width:
        caption = caption[:-1]
    return caption + "…"

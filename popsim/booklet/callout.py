"""The pieces that a step needs, drawn as they lie on their sheets: like the parts list of a building set."""

from collections.abc import Iterator, Sequence

import numpy as np

from popsim.booklet.inks import Ink
from popsim.booklet.panel import fitted
from popsim.booklet.shapes import drawn, moved
from popsim.booklet.thumbnail import bounds, sheet_of, thumbnail
from popsim.geometry.arrays import FloatArray
from popsim.layout import Layout, Piece
from popsim.layout.sheet import Area, Line, Mark, Text, text_width
from popsim.wording import PIECE

HEIGHT, WIDEST, NARROWEST = 18.0, 30.0, 18.0
"""mm; of a strip of pieces, and of the room for one piece."""

WORDS = 2.2
"""mm; font size."""


def draw_callout(layout: Layout, pieces: Sequence[Piece], low: FloatArray, width: float) -> Iterator[Mark]:
    """A strip with a picture of each piece, its name and its sheet; its lower left corner at `low` (2,), mm."""
    room = min(WIDEST, width / len(pieces))
    frame = np.array([[0, 0], [room * len(pieces), 0], [room * len(pieces), HEIGHT], [0, HEIGHT]]) + low
    yield Area(Ink.BUBBLE, (frame,))
    yield Line(Ink.RULE, frame, closed=True)
    for k, piece in enumerate(pieces):
        corner = low + np.array([k * room, 0.0])
        shapes = thumbnail(layout, piece)
        gap = np.array([1.5, 1.5])
        size = np.array([room, HEIGHT]) - 2 * gap - np.array([0.0, 3.4])
        _, motion = fitted(bounds(shapes), corner + gap + np.array([0.0, 3.4]), size)
        yield from drawn(moved(shapes, motion))
        words = PIECE.format(name=piece.name, sheet=sheet_of(layout, piece))
        font = min(WORDS, (room - 1) / text_width(words, 1.0))
        yield Text(Ink.TEXT, words, corner + np.array([room / 2, 1.4]), font, anchor="middle")

"""The sheets with the names of their pieces, small: the figure of the first step."""

from collections.abc import Iterator

import numpy as np

from popsim.booklet.inks import Ink
from popsim.booklet.labels import Labels, Wish
from popsim.booklet.panel import fitted
from popsim.booklet.shapes import drawn, moved
from popsim.booklet.thumbnail import thumbnail
from popsim.geometry.arrays import FloatArray
from popsim.layout import Layout
from popsim.layout.sheet import Area, Line, Mark, Sheet, Text
from popsim.wording import SHEET, STEP

GAP, CAPTION = 5.0, 2.6
"""mm between sheets, and the font size of what stands below them."""

NAME = 2.2
"""mm; font size of the names of pieces."""


def draw_cutting(layout: Layout, number: int, width: float, height: float) -> Sheet:
    """All sheets of a layout in a frame of `width` x `height` mm."""
    marks = [
        mark for index, low, size in _frames(layout, width, height) for mark in _sheet(layout, index, low, size)
    ]
    return Sheet(STEP.format(number=number), width, height, tuple(marks))


def _frames(layout: Layout, width: float, height: float) -> Iterator[tuple[int, FloatArray, FloatArray]]:
    """Index, lower left corner and size of the picture of each sheet, arranged to be as large as can be."""
    paper, count = layout.paper, layout.sheet_count

    def scale(columns: int) -> float:
        rows = -(-count // columns)
        across = (width - (columns - 1) * GAP) / columns / paper.width
        down = (height - rows * (GAP + CAPTION)) / rows / paper.height
        return min(across, down)

    columns = max(range(1, count + 1), key=scale)
    size = scale(columns) * np.array([paper.width, paper.height])
    for index in range(count):
        row, column = divmod(index, columns)
        corner = np.array([column * (size[0] + GAP), height - (row + 1) * size[1] - row * (GAP + CAPTION)])
        yield index, corner, size


def _sheet(layout: Layout, index: int, low: FloatArray, size: FloatArray) -> Iterator[Mark]:
    import shapely

    frame = shapely.box(*low, *(low + size))
    outline = np.array(frame.exterior.coords)[:-1]
    yield Area(Ink.PAPER, (outline,))
    yield Line(Ink.RULE, outline, closed=True)
    whole = np.array([[0.0, 0.0], [layout.paper.width, layout.paper.height]])
    _, motion = fitted(whole, low, size)
    wishes, areas = [], []
    for placement in layout.placements:
        if placement.sheet == index:
            shapes = moved(thumbnail(layout, placement.piece, fill=Ink.PANEL), motion)
            yield from drawn(shapes)
            areas.append(shapes[0].geometry)
            wishes.append(Wish(placement.piece.name, shapes[0].geometry, NAME))
    yield from Labels(frame, shapely.union_all(areas)).place(wishes)
    under = low + np.array([size[0] / 2, -1.2 * CAPTION])
    yield Text(Ink.NOTE, SHEET.format(sheet=index + 1), under, CAPTION, anchor="middle")

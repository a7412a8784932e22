"""One picture of a step: the scene, arrows, an inset where flaps are small, labels."""

from collections.abc import Iterator

import numpy as np

from popsim.booklet.arrows import arrow, sparse
from popsim.booklet.depiction import depict
from popsim.booklet.inks import Ink
from popsim.booklet.inset import choose_inset
from popsim.booklet.labels import Labels
from popsim.booklet.scenery import Scenery
from popsim.booklet.shapes import drawn, moved
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape
from popsim.layout.sheet import Area, Mark

MARGIN = 3.0
"""mm left free round the drawing within its panel."""

LARGEST = 1.2
"""A drawing is never enlarged more than this: small pieces look small."""


def draw_panel(scenery: Scenery, low: FloatArray, size: FloatArray) -> Iterator[Mark]:
    """Marks of a panel with its lower left corner at `low` and of `size`, shapes (2,), mm."""
    import shapely

    window = shapely.box(*low, *(low + size))
    yield Area(Ink.PANEL, (np.array(window.exterior.coords)[:-1],))
    scale, motion = fitted(scenery.bounds, low + MARGIN, size - 2 * MARGIN)
    yield from drawn(moved(depict(scenery.sights, scale), motion))
    arrows = [arrow(track) for track in sparse([move(motion, track) for track in scenery.tracks])]
    for shapes in arrows:
        yield from drawn(shapes)
    taken = [shape.geometry for shapes in arrows for shape in shapes if shape.ink is Ink.ARROW]
    labels = Labels(window.buffer(-0.5), move_shape(motion, scenery.silhouette), taken)
    inset = choose_inset(scenery, motion, scale, window)
    numbers = list(scenery.number_wishes(motion))
    if inset is not None:
        yield from inset.marks(scenery, motion, scale)
        labels.taken += [inset.window, inset.spot]
        numbers = [wish for wish in numbers if not wish.area.intersects(inset.spot)]
    yield from labels.place(numbers)
    yield from labels.place(scenery.name_wishes(motion))


def fitted(bounds: FloatArray, low: FloatArray, size: FloatArray) -> tuple[float, FloatArray]:
    """Scale, and motion (3, 3) that brings `bounds` (2, 2) into the middle of a frame at `low` of `size`."""
    extent = np.maximum(bounds[1] - bounds[0], 1e-6)
    scale = float(min(*(size / extent), LARGEST))
    motion = np.diag([scale, scale, 1.0])
    motion[:2, 2] = low + size / 2 - scale * bounds.mean(axis=0)
    return scale, motion

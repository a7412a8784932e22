"""Arrows along a motion."""

from collections.abc import Sequence

import numpy as np

from popsim.booklet.inks import Ink
from popsim.booklet.shapes import Shape
from popsim.geometry.arrays import FloatArray

HEAD, WING = 3.2, 1.35
"""mm; length of the head of an arrow, and half its width."""

SHORTEST = 4.0
"""mm; motions that are shorter on the page get no arrow."""

ALIKE = 9.0
"""mm; of arrows that begin and end this close to each other one is enough."""


def arrow(track: FloatArray) -> tuple[Shape, ...]:
    """An arrow along a track (n, 2) on the page, mm, with a white rim; nothing for a short one."""
    import shapely
    from shapely.ops import substring

    line = shapely.LineString(track)
    if line.length < SHORTEST:
        return ()
    shaft = substring(line, 0.0, line.length - 0.7 * HEAD)
    tip, back = np.array(track[-1]), np.array(shaft.coords[-1])
    along = (tip - back) / np.linalg.norm(tip - back)
    across = WING * np.array([-along[1], along[0]])
    base = tip - HEAD * along
    head = shapely.Polygon([tip, base + across, base + 0.25 * HEAD * along, base - across])
    return Shape(Ink.ARROW_RIM, shaft.union(head.boundary)), Shape(Ink.ARROW, shaft), Shape(Ink.ARROW, head)


def sparse(tracks: Sequence[FloatArray]) -> list[FloatArray]:
    """The tracks, the longest first, without those that run beside a longer one."""
    kept: list[FloatArray] = []
    for track in sorted(tracks, key=lambda track: -round(float(np.linalg.norm(track[-1] - track[0])), 3)):
        ends = track[[0, -1]]
        if all(np.linalg.norm(ends - other[[0, -1]], axis=1).max() > ALIKE for other in kept):
            kept.append(track)
    return kept

"""Inked shapes: a drawing while it is still geometry, which can be moved, scaled and cut."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.inks import Ink
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.flat import GRID, move
from popsim.layout.sheet import Area, Line, Mark

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

SMALLEST = 0.02
"""mm and mm^2; what is smaller on the page is not drawn."""


@dataclass(frozen=True, eq=False)
class Shape:
    """Areas or lines of one ink."""

    ink: Ink
    geometry: "BaseGeometry"


def moved(shapes: Iterable[Shape], motion: FloatArray) -> tuple[Shape, ...]:
    """The shapes moved and scaled by `motion` (3, 3)."""
    import shapely

    listed = list(shapes)
    places = shapely.transform([shape.geometry for shape in listed], lambda points: move(motion, points))
    return tuple(Shape(shape.ink, place) for shape, place in zip(listed, places, strict=True))


def clipped(shapes: Sequence[Shape], window: "BaseGeometry") -> tuple[Shape, ...]:
    """What of the shapes lies in `window`; rims that rounding has tied into knots are untied before."""
    import shapely

    shapely.prepare(window)
    left, low, right, high = window.bounds
    x0, y0, x1, y1 = shapely.bounds([shape.geometry for shape in shapes]).T
    near = (x0 <= right) & (x1 >= left) & (y0 <= high) & (y1 >= low)  # false for what is empty
    return tuple(
        Shape(shape.ink, untied(shape.geometry).intersection(window))
        for shape, close in zip(shapes, near, strict=True)
        if close
    )


def untied(geometry: "BaseGeometry") -> "BaseGeometry":
    """The geometry with rims untied that moving and rounding have tied into knots: overlays fail on those.

    On a grid, for where edges all but coincide, what is mended is else knotted anew.
    """
    import shapely

    return shapely.set_precision(shapely.make_valid(geometry, method="structure", keep_collapsed=False), GRID)


def drawn(shapes: Iterable[Shape]) -> Iterator[Mark]:
    """The shapes as marks, in the order of their inks; of each its areas, then its lines."""
    import shapely

    order = list(Ink)
    ranked = sorted(shapes, key=lambda shape: order.index(shape.ink))
    parts, owners = shapely.get_parts([shape.geometry for shape in ranked], return_index=True)
    dimensions = shapely.get_dimensions(parts)
    areas, lines = (dimensions == 2) & (shapely.area(parts) > SMALLEST), dimensions == 1
    marks: list[tuple[int, Mark]] = [
        (owner, _area(ranked[owner].ink, part)) for part, owner in zip(parts[areas], owners[areas], strict=True)
    ]
    marks += _lines(ranked, parts[lines], owners[lines])
    yield from (mark for _, mark in sorted(marks, key=lambda marked: marked[0]))


def _area(ink: Ink, part: "Polygon") -> Area:
    return Area(ink, tuple(np.array(ring.coords)[:-1] for ring in (part.exterior, *part.interiors)))


def _lines(ranked: Sequence[Shape], parts: FloatArray, owners: IntArray) -> Iterator[tuple[int, Line]]:
    """Lines of shapes, merged where they meet, each with the place of the shape it is of."""
    import shapely

    places, first = np.unique(owners, return_inverse=True)
    merged, owner = shapely.get_parts(
        shapely.line_merge(shapely.multilinestrings(parts, indices=first)), return_index=True
    )
    long = shapely.length(merged) > SMALLEST
    for line, place in zip(merged[long], places[owner[long]], strict=True):
        points = shapely.get_coordinates(line)
        closed = bool((points[0] == points[-1]).all())
        yield int(place), Line(ranked[place].ink, points[:-1] if closed else points, closed=closed)

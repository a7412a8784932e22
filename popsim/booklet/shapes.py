"""Inked shapes: a drawing while it is still geometry, which can be moved, scaled and cut."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.inks import Ink
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import GRID, move
from popsim.layout.sheet import Area, Line, Mark

if TYPE_CHECKING:
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
    return tuple(Shape(shape.ink, untied(shape.geometry).intersection(window)) for shape in shapes)


def untied(geometry: "BaseGeometry") -> "BaseGeometry":
    """The geometry with rims untied that moving and rounding have tied into knots: overlays fail on those.

    On a grid, for where edges all but coincide, what is mended is else knotted anew.
    """
    import shapely

    return shapely.set_precision(shapely.make_valid(geometry, method="structure", keep_collapsed=False), GRID)


def drawn(shapes: Iterable[Shape]) -> Iterator[Mark]:
    """The shapes as marks, in the order of their inks."""
    import shapely

    order = list(Ink)
    for shape in sorted(shapes, key=lambda shape: order.index(shape.ink)):
        parts = shapely.get_parts(shape.geometry)
        for area in parts[shapely.get_dimensions(parts) == 2]:
            if area.area > SMALLEST:
                rings = (area.exterior, *area.interiors)
                yield Area(shape.ink, tuple(np.array(ring.coords)[:-1] for ring in rings))
        yield from _lines(shape.ink, parts[shapely.get_dimensions(parts) == 1])


def _lines(ink: Ink, parts: FloatArray) -> Iterator[Line]:
    import shapely

    merged = shapely.line_merge(shapely.multilinestrings(parts)) if len(parts) else shapely.MultiLineString()
    for line in shapely.get_parts(merged):
        if line.length > SMALLEST:
            points = shapely.get_coordinates(line)
            closed = bool((points[0] == points[-1]).all())
            yield Line(ink, points[:-1] if closed else points, closed=closed)

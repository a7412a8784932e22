"""Pieces as they lie on their sheets, small: what to look for."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.inks import Ink
from popsim.booklet.shapes import Shape, moved
from popsim.geometry.arrays import FloatArray
from popsim.layout import Crease, Layout, Piece

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

CREASES = {Crease.MOUNTAIN: Ink.MOUNTAIN, Crease.VALLEY: Ink.VALLEY}

SIMPLER = 0.3
"""mm; outlines are drawn this exactly."""


def thumbnail(layout: Layout, piece: Piece, *, fill: Ink = Ink.NEW) -> tuple[Shape, ...]:
    """A piece as it lies on its sheet, in sheet coordinates, mm: filled outline and creases."""
    placement = next(own for own in layout.placements if own.piece is piece)
    return moved(_flat(piece, fill), placement.motion)


def sheet_of(layout: Layout, piece: Piece) -> int:
    """Number of the sheet that a piece is on, from 1."""
    return 1 + next(own.sheet for own in layout.placements if own.piece is piece)


def _flat(piece: Piece, fill: Ink) -> Iterator[Shape]:
    import shapely

    outline: BaseGeometry = piece.outline.simplify(SIMPLER)
    yield Shape(fill, outline)
    yield Shape(Ink.EDGE, outline.boundary)
    yield Shape(Ink.EDGE, shapely.MultiLineString(list(piece.slits)))
    for crease, ink in CREASES.items():
        lines = [fold.ends for fold in piece.folds if fold.crease is crease]
        yield Shape(ink, shapely.MultiLineString(lines))


def bounds(shapes: tuple[Shape, ...]) -> FloatArray:
    """Lowest and highest corner of all shapes, shape (2, 2)."""
    boxes = np.array([shape.geometry.bounds for shape in shapes if not shape.geometry.is_empty])
    return np.array([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])

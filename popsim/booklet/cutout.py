"""Parts and flaps as they are drawn: a little simpler than they are cut, with edges and creases apart."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import inverse, move
from popsim.layout import Flap, Layout, Part, Piece

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

SIMPLER = 0.25
"""mm; outlines are drawn this exactly: half of it on the page, less than a line is wide."""

BESIDE = 0.1
"""mm; edges this close to a crease are part of it."""


@dataclass(frozen=True, eq=False)
class Cutout:
    """Something flat to draw, in its own flat coordinates, mm.

    Attributes
    ----------
    shape:
        Its area.
    edges, creases:
        Lines round it that were cut, and lines along which it is folded or joined within its piece.
    """

    shape: "BaseGeometry"
    edges: "BaseGeometry"
    creases: "BaseGeometry"


def cutout(shape: "BaseGeometry", folds: list[FloatArray]) -> Cutout:
    """Return the cutout of a polygon; `folds` are lines (2, 2) on its outline."""
    import shapely

    drawn = shapely.make_valid(shape.simplify(SIMPLER))
    creases = shapely.MultiLineString(folds)
    return Cutout(drawn, drawn.boundary.difference(creases.buffer(BESIDE)), creases)


def part_cutouts(layout: Layout) -> dict[str, Cutout]:
    """Cutouts of all parts, by part id; creases are those of their pieces, at flaps too."""
    return {name: cutout(part.polygon, _folds(layout.piece_of[name], part)) for name, part in layout.parts.items()}


def _folds(piece: Piece, part: Part) -> list[FloatArray]:
    """The folds of a piece at one of its parts, in the part's flat coordinates, each (2, 2)."""
    import shapely

    back, near = inverse(piece.motions[part.id]), part.polygon.buffer(BESIDE)
    lines = [move(back, fold.ends) for fold in piece.folds if part.id in fold.joint.parts]
    return [line for line in lines if near.contains(shapely.LineString(line))]


def flap_cutout(flap: Flap) -> Cutout:
    """Cutout of a flap, in the flat coordinates of its carrier."""
    return cutout(flap.polygon, [flap.line])

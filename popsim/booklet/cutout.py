"""Parts and flaps as they are drawn: a little simpler than they are cut, with edges and creases apart."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.layout import Crease, Flap, Layout, Part
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

SIMPLER = 0.15
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
    folds: dict[str, list[FloatArray]] = {name: [] for name in layout.parts}
    for piece in layout.pieces:
        for fold in piece.folds:
            if fold.crease is Crease.NONE:
                continue
            for name in fold.joint.parts:
                if name in piece.motions:
                    inverse = np.linalg.inv(piece.motions[name])
                    folds[name].append(fold.ends @ inverse[:2, :2].T + inverse[:2, 2])
    return {name: cutout(part.polygon, folds[name]) for name, part in layout.parts.items()}


def flap_cutout(flap: Flap) -> Cutout:
    """Cutout of a flap, in the flat coordinates of its carrier."""
    return cutout(flap.polygon, [flap.line])


def glued_side(flap: Flap, target: Part) -> FloatArray:
    """Unit normal (3,), in the open pose, of the face of the target that the flap is glued to."""
    return target.plane.normal * (1.0 if flap.face is Face.PRINTED else -1.0)

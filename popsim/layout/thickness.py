"""Room for paper that has a thickness t.

The planes of a design are the middles of its papers, and its lines the middles of creases. So

- a flap keeps KNIFE + t off the rim of what it is glued to and off every line at which something else turns
  there: the fold beside it can still close over the flap, which is t thick;
- an edge that nothing holds and that butts against another patch in the open pose ends t / 2 short of it, where
  the face of that patch begins: inner patches, end pairs under their tops, walls that slide on the ground. Where
  two such edges meet in a corner, both do, and neither rubs on the other.

Thickness adds up in the closed card; that is judged by folding it as paper, not by the sheets.
"""

from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design
from popsim.design.rules import coplanar
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import without
from popsim.layout.parts import Part

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

KNIFE = 0.25
"""mm; what cutting and gluing by hand is off."""

USUAL = 0.25
"""mm; thickness of the paper where none is named: 200 g/m2."""

BUTTS = 0.1
"""mm; an edge this near to another patch butts against it: what contours deviate."""

HELD = 0.3
"""mm; edges this near to a hinge are held there."""

SHORTEST = 1.0
"""mm; shorter stretches of an edge are not cut back."""


def cut_back(parts: tuple[Part, ...], design: Design, thickness: float) -> tuple[Part, ...]:
    """The parts with free edges that butt against other patches cut back by half the thickness, mm."""
    if not thickness:
        return parts
    return tuple(_cut_back(part, parts, design, thickness / 2) for part in parts)


def _cut_back(part: Part, parts: tuple[Part, ...], design: Design, depth: float) -> Part:
    import shapely

    hinges = design.hinges_by_patch[part.patch.id]
    held = shapely.unary_union([shapely.LineString(part.flat(hinge.points)).buffer(HELD) for hinge in hinges])
    edges = [
        edge
        for other in parts
        if other.patch is not part.patch and not coplanar(part.patch, other.patch)
        for edge in _butting(part, other)
    ]
    free = [line for edge in edges for line in shapely.get_parts(_free(edge, held)) if line.length > SHORTEST]
    strips = [line.buffer(depth, cap_style="flat") for line in free]
    if not strips:
        return part
    rest = without(part.polygon, shapely.unary_union(strips))
    main = max(shapely.get_parts(rest), key=lambda shape: shape.area)
    return Part(part.id, part.patch, part.plane, shapely.orient_polygons(main))


def _free(edge: "BaseGeometry", held: "BaseGeometry") -> "BaseGeometry":
    """What of an edge no hinge holds; one that only starts at a hinge is free from its start."""
    return without(edge, held) if edge.intersection(held).length > 4 * HELD else edge


def _butting(part: Part, other: Part) -> list["BaseGeometry"]:
    """Stretches of the outline of `part` that lie on `other`, in the flat coordinates of `part`."""
    import shapely

    near = other.polygon.buffer(BUTTS)
    found: list[BaseGeometry] = []
    for ring in (part.polygon.exterior, *part.polygon.interiors):
        corners = part.plane.lift(np.array(ring.coords))
        beside = np.abs(other.plane.distance(corners)) < BUTTS
        for k in np.flatnonzero(beside[:-1] & beside[1:]):
            edge = shapely.LineString(other.flat(corners[k : k + 2])).intersection(near)
            found += [shapely.LineString(_carried(piece, other, part)) for piece in shapely.get_parts(edge)]
    return found


def _carried(line: "BaseGeometry", start: Part, target: Part) -> FloatArray:
    """Points of `line` in the flat coordinates of `target`, from those of `start`."""
    import shapely

    return target.flat(start.plane.lift(shapely.get_coordinates(line)))

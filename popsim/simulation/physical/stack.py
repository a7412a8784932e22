"""How high the closed card is."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.rigid import transform
from popsim.simulation.sweep import Sweep

if TYPE_CHECKING:
    from shapely.geometry import Polygon

SLIVER = 0.5
"""mm2; where less than this lies on each other, nothing is measured: edges that touch."""

GRID = 1e-4
"""mm; outlines that are nearer than this share their edges."""


@dataclass(frozen=True)
class Stack:
    """The thickest place of the closed card.

    Attributes
    ----------
    height:
        mm: thickness of all patches that lie on each other there, pages included. Flaps are not known before the
        sheets are laid out; each adds its thickness where it is glued.
    patches:
        Their ids.
    place:
        A point of it: x along the central fold and distance from it, mm.
    """

    height: float
    patches: tuple[str, ...]
    place: tuple[float, float]


def closed_stack(sweep: Sweep, thickness: float) -> Stack:
    """Count the layers of paper of `thickness` mm wherever on the closed card their number differs."""
    from shapely import STRtree, get_parts, polygonize, union_all

    shapes = [_lying(sweep, place) for place in range(len(sweep.design.patches))]
    edges = union_all([shape.boundary for shape in shapes], grid_size=GRID)
    cells = [cell for cell in get_parts(polygonize(get_parts(edges))) if cell.area > SLIVER]
    inside = [cell.representative_point() for cell in cells]
    where, which = STRtree(shapes).query(inside, predicate="within")
    highest = int(np.bincount(where, minlength=len(cells)).argmax())
    layers = sorted(which[where == highest].tolist())
    names = tuple(sweep.design.patches[place].id for place in layers)
    return Stack(thickness * len(layers), names, (inside[highest].x, inside[highest].y))


def _lying(sweep: Sweep, place: int) -> "Polygon":
    """A patch of the closed card, by x and distance from the central fold."""
    from shapely.geometry import Polygon

    patch, pose = sweep.design.patches[place], sweep.poses[sweep.closed, place]
    outline, *holes = (transform(pose, ring)[:, [0, 2]] for ring in (patch.points, *patch.hole_points))
    return Polygon(outline, holes)

"""Bridges between the parts of a patch: strips of paper that stay in its room."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.patches.clean import common, polygons, union
from popsim.patches.sight import Grid

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

    from popsim.patches.piece import Piece

WIDTH = 3.0
"""mm."""

STEP = 1.0
"""mm between the places that a way round may take."""

FACING = 0.1
"""mm; what is farther by no more than this is as near as the nearest."""

EDGE = 4.0
"""Price of a mm along the edge of a room, where only part of a bridge has paper; a mm amid it costs 1."""


def straight(start: "Polygon", end: "Polygon", piece: "Piece") -> "BaseGeometry":
    """A bridge along the shortest line between two shapes; in parts where that leaves the room of the piece.

    Where two sides face each other it stands amid them: at their end half of its width would have no paper.
    """
    from shapely import shortest_line

    facing = polygons(common(end, start.buffer(start.distance(end) + FACING)))
    line = shortest_line(start, facing[0].centroid if facing else end)
    return common(line.buffer(WIDTH / 2, cap_style="square"), piece.room)


def way_round(start: "Polygon", end: "Polygon", piece: "Piece") -> "BaseGeometry":
    """A bridge along the shortest way between two shapes within the room of a piece; empty where there is none."""
    from shapely import shortest_line
    from shapely.geometry import LineString, Polygon
    from skimage.graph import MCP_Geometric

    grid = Grid.over(piece.plane, piece.room.bounds, STEP)
    costs = np.where(grid.covered(piece.room), EDGE, np.inf)
    costs[grid.covered(piece.room.buffer(-WIDTH / 2))] = 1.0
    starts, ends = (np.argwhere(grid.covered(each.buffer(STEP)) & np.isfinite(costs)) for each in (start, end))
    if not len(starts) or not len(ends):
        return Polygon()
    search = MCP_Geometric(costs)
    total, _ = search.find_costs(starts, ends, find_all_ends=False)
    nearest = ends[total[tuple(ends.T)].argmin()]
    if not np.isfinite(total[tuple(nearest)]):
        return Polygon()
    places = grid.flat(np.array(search.traceback(nearest), dtype=np.float64))
    way = LineString(places if len(places) > 1 else np.repeat(places, 2, axis=0)).simplify(STEP)
    links = [shortest_line(shape, way) for shape in (start, end)]
    return common(union(*(line.buffer(WIDTH / 2, cap_style="square") for line in (way, *links))), piece.room)

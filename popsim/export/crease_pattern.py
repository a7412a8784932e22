"""Crease patterns as simulators of origami take them: triangles between creases, borders and cuts of a piece.

Simulators fail on slivers and on lines that nearly meet. Corners closer than about `APART` are therefore one, and
lines that pass a corner as near as that pass through it; other corners stay where they are. Each crease is there
once, also where it ends just beside a border. What runs as near to a border as that is left out, and so is a cut
that runs as near to a crease.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.geometry.flat import flat_motion, move_shape

if TYPE_CHECKING:
    from shapely import STRtree
    from shapely.geometry import LineString, Polygon
    from shapely.geometry.base import BaseGeometry

APART = 0.2
"""mm between two corners, at least; as far as a cutter is off, and no paper holds on less."""

ASIDE = np.array([0.0137, 0.0271])
"""mm from the grid on which corners become one: away from round numbers, which lie between two of its places."""

FLATTEST = 0.5 * APART
"""mm; triangles are at least that high, if corners left where they are can make them so."""


class Edge(NamedTuple):
    """What an edge is in FOLD, and the angle by which the paper is bent there, degrees; None if unknown."""

    assignment: str
    angle: float | None = 0.0


BORDER, CUT, WITHIN = Edge("B"), Edge("C"), Edge("F")
"""Edges of the paper, cuts into it, and edges between triangles of one face."""


class Triangles(NamedTuple):
    """A piece cut into triangles.

    Attributes
    ----------
    corners:
        Shape (n, 2), mm.
    faces:
        Counterclockwise corners of each triangle, shape (m, 3).
    edges:
        What the edges are that lie on lines, by their corners, the lower first; the others are within one face.
    """

    corners: FloatArray
    faces: IntArray
    edges: dict[tuple[int, int], Edge]


def triangles(
    outline: "Polygon", creases: "Iterable[tuple[LineString, Edge]]", cuts: "Iterable[LineString]"
) -> Triangles:
    """What outline, creases and cuts enclose, in triangles.

    Parameters
    ----------
    outline:
        Of the piece, mm; its holes are no part of the pattern.
    creases:
        Straight lines, and what each is.
    cuts:
        Lines within the outline along which the paper comes apart.
    """
    import shapely

    aside = flat_motion(0.0, ASIDE)
    outline = move_shape(aside, outline)
    rings = [shapely.LineString(ring) for ring in (outline.exterior, *outline.interiors)]
    lines = [(_reaching(move_shape(aside, crease), outline.boundary), what) for crease, what in creases]
    lines += [(ring, BORDER) for ring in rings]
    lines += [(_halved(move_shape(aside, line)), CUT) for line in cuts]
    raw = [line for line, _ in lines]
    noded = shapely.get_parts(shapely.unary_union(raw, grid_size=APART))
    found = shapely.get_parts(shapely.polygonize(noded))
    inside = [face for face in found if outline.contains(face.representative_point())]
    corners, index = _corners(noded)
    faces = np.array(
        [[index[key] for key in _keys(triangle)] for face in inside for triangle in triangulated(face)],
        dtype=np.intp,
    ).reshape(-1, 3)
    segments = {
        ordered(index[a], index[b]) for line in noded for a, b in pairwise(_keys(shapely.get_coordinates(line)))
    }
    pixels = shapely.STRtree(shapely.box(*(corners - APART / 2).T, *(corners + APART / 2).T))
    edges: dict[tuple[int, int], Edge] = {}
    for line, what in lines:
        for edge in _image(line, corners, pixels):
            if edge in segments:
                edges.setdefault(edge, what)
    return Triangles(_put_back(corners, faces, _spots(raw)) - ASIDE, faces, edges)


def _reaching(crease: "LineString", border: "BaseGeometry") -> "LineString":
    """A crease, drawn on to the border where it ends just beside it: else it would bound no face."""
    import shapely

    ends = shapely.get_coordinates(crease)
    onto = shapely.get_coordinates(shapely.shortest_line(shapely.points(ends), border))[1::2]
    away = np.linalg.norm(onto - ends, axis=1)
    near = (away > 0.0) & (away <= APART)
    return shapely.LineString(np.vstack([onto[:1][near[:1]], ends, onto[1:][near[1:]]]))


def _halved(line: "LineString") -> "LineString":
    """A cut with a corner in the middle of each straight part: where faces come apart though its ends hold."""
    import shapely

    corners = shapely.get_coordinates(line)
    middles = (corners[:-1] + corners[1:]) / 2
    return shapely.LineString(np.insert(corners, np.arange(1, len(corners)), middles, axis=0))


def _corners(noded: "Sequence[LineString]") -> tuple[FloatArray, dict[tuple[int, int], int]]:
    """Corners of the noded lines, shape (n, 2), and the index of each by its place on the grid."""
    import shapely

    index: dict[tuple[int, int], int] = {}
    for key in _keys(shapely.get_coordinates(noded)):
        index.setdefault(key, len(index))
    return np.array(list(index), dtype=float) * APART, index


def _keys(points: FloatArray) -> list[tuple[int, int]]:
    """Places of points (n, 2) on the grid."""
    return [(int(x), int(y)) for x, y in np.round(points / APART)]


def ordered(one: int, other: int) -> tuple[int, int]:
    """The edge between two corners, from the lower one."""
    return (one, other) if one < other else (other, one)


def triangulated(face: "Polygon") -> list[FloatArray]:
    """Counterclockwise triangles of a face, each of shape (3, 2); all its corners are used, straight ones too."""
    import shapely

    found = shapely.orient_polygons(shapely.get_parts(shapely.constrained_delaunay_triangles(face)))
    return [shapely.get_coordinates(shape.exterior)[:-1] for shape in found]


def _image(line: "LineString", corners: FloatArray, pixels: "STRtree") -> Iterator[tuple[int, int]]:
    """What a line has become: the corners whose `pixels` of the grid it passes, in pairs."""
    import shapely

    for start, end in pairwise(shapely.get_coordinates(line)):
        passed = pixels.query(shapely.LineString([start, end]), "intersects")
        along = np.argsort((corners[passed] - start) @ (end - start), kind="stable")
        yield from (ordered(int(a), int(b)) for a, b in pairwise(passed[along]))


def _spots(lines: "Sequence[LineString]") -> FloatArray:
    """Ends and crossings of lines, shape (n, 2), as they were before corners were put together."""
    import shapely

    return np.asarray(shapely.get_coordinates(shapely.unary_union(list(lines))))


def _put_back(corners: FloatArray, faces: IntArray, spots: FloatArray) -> FloatArray:
    """Corners (n, 2), moved back from the grid to the nearest of `spots`, but where that would flatten a face."""
    from scipy.spatial import KDTree

    _, nearest = KDTree(spots).query(corners)
    exact = spots[nearest]
    kept = np.linalg.norm(exact - corners, axis=1) < APART
    while (flat := _heights(np.where(kept[:, None], exact, corners), faces) < FLATTEST).any():
        still = np.unique(faces[flat])
        if not kept[still].any():
            break  # flat as it stands
        kept[still] = False
    return np.where(kept[:, None], exact, corners)


def _heights(corners: FloatArray, faces: IntArray) -> FloatArray:
    """Signed height of each triangle over its longest side, mm."""
    first, second, third = (corners[faces[:, i]] for i in range(3))
    one, other = second - first, third - first
    longest = np.max([np.linalg.norm(side, axis=1) for side in (one, other, third - second)], axis=0)
    return np.asarray((one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) / longest)

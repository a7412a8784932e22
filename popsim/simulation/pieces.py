"""Convex pieces that cover a patch, holes left free."""

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray

STRAIGHT = 1e-9
"""Of the square of the patch's extent: turns below this count as straight."""

BRIDGE = 0.2
"""How far a bridge over an inner edge reaches toward the far corners of the two triangles beside it."""

Ring = list[int]


def convex_pieces(patch: Patch) -> tuple[FloatArray, ...]:
    """Convex polygons in the plane of `patch` whose union is the patch, each of shape (k, 3).

    Triangles merged where the union stays convex, and a small bridge over every inner edge that is left: a plate
    that cuts the patch exactly along such an edge would touch both pieces and cross none.
    """
    flat = [patch.plane.flat(ring) for ring in (patch.points, *patch.hole_points)]
    points = np.concatenate(flat)
    tolerance = STRAIGHT * float(np.ptp(points, axis=0).max()) ** 2
    if len(flat) == 1 and _convex(points, list(range(len(points))), tolerance):
        return (patch.points,)
    triangles = _triangles(points, [len(ring) for ring in flat], tolerance)
    pieces = _merged(points, triangles, tolerance)
    rings = [points[piece] for piece in pieces] + _bridges(points, triangles, pieces)
    return tuple(patch.plane.lift(ring) for ring in rings)


def _triangles(points: FloatArray, lengths: list[int], tolerance: float) -> list[Ring]:
    """Counterclockwise triangles of a polygon with holes; slivers without area are left out."""
    import mapbox_earcut

    ends = np.cumsum(lengths).astype(np.uint32)
    corners = mapbox_earcut.triangulate_float64(points, ends).reshape(-1, 3)
    triangles = []
    for a, b, c in corners.tolist():
        turn = _turn(points[a], points[b], points[c])
        if abs(turn) > tolerance:
            triangles.append([a, b, c] if turn > 0 else [a, c, b])
    return triangles


def _merged(points: FloatArray, triangles: list[Ring], tolerance: float) -> list[Ring]:
    """Join neighbours over their common edge as long as the union is convex; each two are tried once."""
    pieces = dict(enumerate(triangles))
    refused: set[tuple[int, int, int]] = set()

    def joined() -> tuple[int, int, Ring] | None:
        owner = {edge: name for name, piece in pieces.items() for edge in _edges(piece)}
        for name, piece in pieces.items():
            for start, end in _edges(piece):
                other = owner.get((end, start))
                if other is None or other == name or (name, other, start) in refused:
                    continue
                union = _join(piece, pieces[other], (start, end))
                if len(set(union)) == len(union) and _convex(points, union, tolerance):
                    return name, other, union
                refused.add((name, other, start))
        return None

    following = len(triangles)
    while (found := joined()) is not None:
        first, second, union = found
        del pieces[first], pieces[second]
        pieces[following] = union
        following += 1
    return list(pieces.values())


def _join(first: Ring, second: Ring, edge: tuple[int, int]) -> Ring:
    """Ring around two rings that share `edge` (as it runs in the first)."""
    start, end = edge
    at = first.index(end)
    around = first[at:] + first[:at]
    at = second.index(start)
    rest = second[at:] + second[:at]
    return around + rest[1:-1]


def _bridges(points: FloatArray, triangles: list[Ring], pieces: list[Ring]) -> list[FloatArray]:
    """A kite over each edge between two pieces."""
    inside = {frozenset(edge) for piece in pieces for edge in _edges(piece)}
    apex = {
        edge: next(c for c in triangle if c not in edge) for triangle in triangles for edge in _edges(triangle)
    }
    kites = []
    for (start, end), left in apex.items():
        right = apex.get((end, start))
        if right is not None and start < end and frozenset((start, end)) in inside:
            middle = (points[start] + points[end]) / 2
            wings = [middle + BRIDGE * (points[corner] - middle) for corner in (right, left)]
            kites.append(np.array([points[start], wings[0], points[end], wings[1]]))
    return kites


def _edges(ring: Ring) -> list[tuple[int, int]]:
    return list(zip(ring, ring[1:] + ring[:1], strict=True))


def _convex(points: FloatArray, ring: Ring, tolerance: float) -> bool:
    """Whether a counterclockwise ring turns left everywhere, and only once around."""
    corners = points[ring]
    sides = np.roll(corners, -1, axis=0) - corners
    following = np.roll(sides, -1, axis=0)
    turns = sides[:, 0] * following[:, 1] - sides[:, 1] * following[:, 0]
    angles = np.arctan2(turns, (sides * following).sum(axis=1))
    return bool((turns >= -tolerance).all() and abs(angles.sum() - 2 * np.pi) < 1e-3)


def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> float:
    """Twice the signed area of a triangle."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

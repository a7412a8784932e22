"""The shape of one flap: a trapezoid, trimmed to where paper may go."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

CLEARANCE = 0.5
"""mm; a flap stays this far inside the outline of its target and off other lines: cutting by hand errs less."""

APART = 0.3
"""mm; a flap keeps this distance from other paper of its own piece, so that scissors can go between."""

SLIVER = 0.4
"""mm; spikes narrower than twice this are cut away: nobody can cut or glue them."""


def trapezoid(length: float, depth: float) -> "Polygon":
    """Flap over an edge of `length`, 45 degree sides, in strip coordinates (along the edge, away from it).

    Its depth is at most half the edge; its ends stay clear of the corners.
    """
    from shapely.geometry import Polygon

    inset = min(CLEARANCE, length / 10)
    depth = min(depth, length / 2 - inset)
    rise = [(inset, 0.0), (length - inset, 0.0), (length - inset - depth, depth), (inset + depth, depth)]
    return Polygon(rise)


def trimmed(flap: "Polygon", blocked: "BaseGeometry", allowed: "BaseGeometry") -> "Polygon | None":
    """What of `flap` (strip coordinates) lies in `allowed` and off `blocked`, in one piece along its edge."""
    import shapely

    rest = flap.intersection(allowed).difference(blocked)
    rest = rest.buffer(-SLIVER, join_style="mitre").buffer(SLIVER, join_style="mitre").intersection(flap)
    pieces = [(piece, hold(piece)) for piece in shapely.get_parts(rest) if piece.geom_type == "Polygon"]
    best = max(pieces, key=lambda pair: (pair[1], pair[0].area), default=(None, 0.0))
    if best[0] is None or best[1] <= 0:
        return None
    return shapely.orient_polygons(shapely.Polygon(best[0].exterior).simplify(0.01))


def hold(flap: "Polygon") -> float:
    """Length over which a flap hangs on its edge, mm."""
    low, high = crease_span(flap)
    return high - low


def crease_span(flap: "Polygon") -> tuple[float, float]:
    """Ends of the crease of a flap, mm along its edge."""
    on_line = [x for x, y in flap.exterior.coords if abs(y) < 1e-6]
    return (min(on_line), max(on_line)) if on_line else (0.0, 0.0)

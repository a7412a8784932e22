"""The outline of a patch is one polygon: islands are joined or dropped, small holes filled."""

from typing import TYPE_CHECKING

from popsim.patches.clean import common, polygons, simplified, straightened, tidy, union
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

NEAR = 4.0
"""mm; islands nearer than this are joined by a bridge."""

WORTHY = 20.0
"""mm^2; islands below this are dropped without a bridge, and below its half without a note."""

SEEN_THROUGH = 6.0
"""mm; a patch inside has no narrower holes."""

BRIDGE = 3.0
"""mm; width of bridges."""

EDGE = 0.8
"""Share of a bridge below which it runs along the edge of its room."""


def finished(piece: Piece, settings: PatchSettings) -> tuple["Polygon", list[str]]:
    """The outline of a patch, ready to cut, and what had to be changed in it.

    Where nothing is left it is the face.
    """
    shape = union(simplified(piece.shape, settings), *piece.held)
    shape = straightened(shape, piece.face, settings)
    outline, notes = _one_piece(polygons(shape), piece)
    if outline is None:
        return piece.face, [f"{piece.id}: the model does not show on it; it is the plain face"]
    return tidy(_without_small_holes(outline, piece, settings)), notes


def _one_piece(parts: list["Polygon"], piece: Piece) -> tuple["Polygon | None", list[str]]:
    if not parts:
        return None, []
    main, notes = parts[0], []
    for island in parts[1:]:
        needed = any(strip.intersection(island).area > 0 for strip in piece.held)
        if needed or (island.area >= WORTHY and island.distance(main) <= NEAR):
            main = _joined(main, island, piece)
        elif island.area >= WORTHY / 2:
            notes.append(f"{piece.id}: an island of {island.area:.0f} mm² is left out")
    return main, notes


def _joined(main: "Polygon", island: "Polygon", piece: Piece) -> "Polygon":
    """Two polygons joined by the shortest bridge that stays in the room, or by all of the face between them.

    Where a bridge would leave the room, as from one fin to another, it starts from what lies in the face.
    """
    bridges = [_bridge(start, island, piece.room) for start in (main, common(main, piece.face))]
    for link in (*bridges, common(union(main, island).convex_hull, piece.face), piece.face):
        parts = polygons(union(main, island, link))
        if len(parts) == 1:
            return parts[0]
    return main


def _bridge(start: "BaseGeometry", end: "BaseGeometry", room: "Polygon") -> "BaseGeometry":
    """A strip along the shortest line between two shapes, within a room; to one side of it at an edge."""
    from shapely import shortest_line

    if start.is_empty:
        return start
    line = shortest_line(start, end)
    middle = common(line.buffer(BRIDGE / 2, cap_style="square"), room)
    return middle if middle.area > EDGE * BRIDGE * line.length else common(line.buffer(BRIDGE), room)


def _without_small_holes(outline: "Polygon", piece: Piece, settings: PatchSettings) -> "Polygon":
    """`outline` with the holes that can be cut; of patches inside only large ones are seen."""
    from shapely.geometry import Polygon

    width = settings.thinnest if piece.plate.principal else SEEN_THROUGH
    holes = [ring for ring in outline.interiors if not Polygon(ring).buffer(-width / 2).is_empty]
    return Polygon(outline.exterior, holes)

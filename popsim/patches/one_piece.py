"""The outline of a patch is one polygon: islands are joined or dropped, small holes filled."""

from typing import TYPE_CHECKING

import numpy as np

from popsim.patches.bridge import WIDTH, straight, way_round
from popsim.patches.clean import polygons, simplified, straightened, tidy, union, without
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon

NEAR = 4.0
"""mm; islands nearer than this are joined by a bridge, of whatever size."""

WORTH = 0.2
"""Share of an island's area that the bridge to it may have: the larger it is, the longer a bridge it is worth."""

LONGEST = 25.0
"""mm; a longer bridge would not hold an island in its plane, however large it is."""

WORTHY = 20.0
"""mm^2; islands below this are dropped without a bridge, and below its half without a note."""

SEEN_THROUGH = 3.0
"""mm; a patch inside has no narrower holes."""


def finished(piece: Piece, settings: PatchSettings) -> tuple["Polygon", list[str]]:
    """The outline of a patch, ready to cut, and what had to be changed in it.

    Where nothing is left it is the face.
    """
    shape = union(simplified(piece.shape, settings), *piece.held)
    shape = straightened(shape, piece.face, settings)
    outline, notes = in_one_piece(polygons(shape), piece)
    if outline is None:
        return piece.face, [f"{piece.id}: the model does not show on it; it is the plain face"]
    return tidy(_without_small_holes(outline, piece, settings)), notes


def in_one_piece(parts: list["Polygon"], piece: Piece) -> tuple["Polygon | None", list[str]]:
    """The largest of some parts of a piece, joined by what is near, large or needed at its hinges; and notes.

    The nearest part comes next, so that islands may lead to others.
    """
    if not parts:
        return None, []
    main, left, notes = parts[0], parts[1:], []
    while left:
        island = left.pop(int(np.argmin([part.distance(main) for part in left])))
        if any(strip.intersection(island).area > 0 for strip in piece.held):
            main = _joined(main, island, piece)
        elif (joined := _joined_by_bridge(main, island, piece)) is not None:
            if (gap := island.distance(main)) > NEAR:
                notes.append(f"{piece.id}: an island of {island.area:.0f} mm² is joined over {gap:.0f} mm")
            main = joined
        elif island.area >= WORTHY / 2:
            notes.append(f"{piece.id}: an island of {island.area:.0f} mm² is left out")
    return main, notes


def reach(island: "Polygon") -> float:
    """How long a bridge to an island may be, mm; 0 where none is worth it."""
    if island.area < WORTHY:
        return 0.0
    return min(max(NEAR, WORTH * float(island.area) / WIDTH), LONGEST)


def _joined_by_bridge(main: "Polygon", island: "Polygon", piece: Piece) -> "Polygon | None":
    """Two polygons joined by a bridge that the island is worth; None where there is no such bridge."""
    allowed = reach(island)
    if not 0 < allowed >= island.distance(main):
        return None
    for bridge in (straight, way_round):
        paper = bridge(main, island, piece)
        parts = polygons(union(main, island, paper))
        if len(parts) == 1 and without(paper, union(main, island)).area <= WIDTH * (allowed + WIDTH):
            return parts[0]
    return None


def _joined(main: "Polygon", island: "Polygon", piece: Piece) -> "Polygon":
    """Two polygons joined by a bridge: straight, or around what is no room; at worst by all of the face."""
    for bridge in (straight, way_round):
        parts = polygons(union(main, island, bridge(main, island, piece)))
        if len(parts) == 1:
            return parts[0]
    parts = polygons(union(main, island, piece.face))
    return parts[0] if len(parts) == 1 else main


def _without_small_holes(outline: "Polygon", piece: Piece, settings: PatchSettings) -> "Polygon":
    """`outline` with the holes that can be cut; of patches inside only large ones are seen."""
    from shapely.geometry import Polygon

    width = settings.thinnest if piece.plate.principal else SEEN_THROUGH
    holes = [ring for ring in outline.interiors if not Polygon(ring).buffer(-width / 2).is_empty]
    return Polygon(outline.exterior, holes)

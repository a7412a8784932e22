"""What stands in a corner beside a mechanism leaves no room for eaves and ears over that corner."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Mechanism, PairKind
from popsim.patches.clean import common, polygons
from popsim.patches.piece import Piece

if TYPE_CHECKING:
    from shapely.geometry import Polygon

SWING = 15.0
"""mm along x that ears swing over while closing."""

FAR = 1e4
"""mm; beyond any patch."""


def clear_corners(mechanisms: Sequence[Mechanism], pieces: Mapping[str, Piece]) -> None:
    """End the rooms of plates at the wall of each corner in which another mechanism stands, near to that one."""
    owners = {mechanism.id: mechanism for mechanism in mechanisms}
    for child in mechanisms:
        owner = owners.get(child.pair.owner or "")
        if owner is None or child.pair.kind is not PairKind.CORNER:
            continue
        x = np.concatenate([plate.outline[:, 0] for plate in child.plates()])
        for plate in owner.plates():
            near = plate.outline[:, 0].min() < x.max() + SWING and plate.outline[:, 0].max() > x.min() - SWING
            if near:
                _end_room(pieces[owner.patch_id(plate.role)], child)


def _end_room(piece: Piece, child: Mechanism) -> None:
    """Leave of a room what lies on the near side of the wall of the child's corner."""
    wall = np.array([0.0, child.pair.side.value, 0.0])
    flat = np.array([piece.plane.u @ wall, piece.plane.v @ wall])
    steep = float(np.linalg.norm(flat))
    if steep < 1e-6:  # the plate is parallel to the wall
        return
    reach = (child.pair.u - piece.plane.origin @ wall) / steep
    room = polygons(common(piece.room, _half_plane(flat / steep, reach)).union(piece.face))
    piece.room = room[0]


def _half_plane(direction: FloatArray, reach: float) -> "Polygon":
    """All points up to `reach` along a unit direction (2,)."""
    from shapely.geometry import Polygon

    across = np.array([-direction[1], direction[0]]) * FAR
    edge = direction * reach
    return Polygon(
        [edge - across, edge + across, edge + across - FAR * direction, edge - across - FAR * direction]
    )

"""A plate while its outline is being cut: everything in the flat coordinates of its plane."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.mechanisms import Mechanism, Plate
from popsim.mechanisms.plate import FIRST_BASE, SECOND_BASE
from popsim.patches.settings import PatchSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry


@dataclass(eq=False)
class Piece:
    """A plate and the outline it has so far.

    Attributes
    ----------
    id:
        Of the patch.
    plate:
        The plate.
    plane:
        Its plane, with the normal outward: flat coordinates are seen from outside.
    face, room:
        Face and room of the plate, flat.
    box:
        Part of space whose model belongs to it, rows low and high, shape (2, 3).
    shape:
        The outline so far: any number of polygons, possibly none.
    recesses:
        Where the model shows however deep it lies: doorways and shelves are dents of a wall, not gaps.
    seams:
        Lines at which the face goes on as that of a neighbour in the same plane, each of shape (2, 2).
    stands:
        Whether it is hinged to what its mechanism stands on.
    held:
        Paper at the hinges, which must stay.
    """

    id: str
    plate: Plate
    plane: Plane
    face: "Polygon"
    room: "Polygon"
    box: FloatArray
    shape: "BaseGeometry"
    recesses: "BaseGeometry"
    seams: list[FloatArray] = field(default_factory=list)
    stands: bool = True
    held: list["BaseGeometry"] = field(default_factory=list)


def pieces_of(
    mechanism: Mechanism, plates: Sequence[Plate], box: FloatArray, settings: PatchSettings
) -> list[Piece]:
    """Some plates of a mechanism, with nothing cut yet; rooms end with the box of space that belongs to it."""
    from shapely.geometry import Polygon

    pieces = []
    for plate in plates:
        name = mechanism.patch_id(plate.role)
        plane = Plane.facing(plate.outward, plate.outline[0])
        face = Polygon(plane.flat(plate.outline))
        allowed = plate.outline if name in settings.within_face else plate.left
        room = _within(Polygon(plane.flat(allowed)), plane, box).union(face)
        joints = [joint for joint in mechanism.joints() if plate.role in joint.roles]
        seams = [plane.flat(joint.axis) for joint in joints if joint.crease is not None]
        stands = any(base in joint.roles for joint in joints for base in (FIRST_BASE, SECOND_BASE))
        pieces.append(Piece(name, plate, plane, face, room, box, Polygon(), Polygon(), seams, stands))
    return pieces


def _within(room: "Polygon", plane: Plane, box: FloatArray) -> "Polygon":
    """The part of a room that lies over a box of space; the whole where that is not one piece."""
    import shapely

    corners = np.stack(np.meshgrid(*box.T, indexing="ij"), axis=-1).reshape(-1, 3)
    left, lower, right, upper = shapely.MultiPoint(plane.flat(corners)).bounds
    part = room.intersection(shapely.box(left, lower, right, upper))
    return part if isinstance(part, shapely.Polygon) and not part.is_empty else room

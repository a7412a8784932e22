"""Where paper lies at one moment of the assembly."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.rigid import transform
from popsim.layout import Flap, Part

FlapKey = tuple[str, int]
"""Id of the joint and index of its stretch: what tells one flap from another."""


def flap_key(flap: Flap) -> FlapKey:
    """The key of a flap in a scene."""
    return flap.joint.id, flap.stretch


@dataclass(frozen=True, eq=False)
class Scene:
    """What lies on the table, and where.

    The frame of the table: mm, z points up. The card, where it is in hand, lies with the ground as in the open
    pose of :mod:`popsim.geometry` (its fold on the x axis, the ground in z = 0, y > 0). Anything else lies with
    the face that is worked on upward and around the origin.

    Attributes
    ----------
    poses:
        Rigid motion (4, 4) of each part from the open pose, in which a design is stored, to where it is now, by
        part id. Parts that are not in hand are not in it.
    flaps:
        The same for each flap of these parts, by its key: the motion of its outline as it lies flat beside its
        carrier, in the carrier's plane of the open pose.
    card_angle:
        Fold angle of the card, rad; None where the card is not in hand.
    """

    poses: Mapping[str, FloatArray]
    flaps: Mapping[FlapKey, FloatArray]
    card_angle: float | None = None

    def __post_init__(self) -> None:
        poses = {name: locked(pose, (4, 4), f"pose of {name}") for name, pose in self.poses.items()}
        flaps = {key: locked(pose, (4, 4), f"pose of {key}") for key, pose in self.flaps.items()}
        object.__setattr__(self, "poses", MappingProxyType(poses))
        object.__setattr__(self, "flaps", MappingProxyType(flaps))

    def outline(self, part: Part) -> FloatArray:
        """Corners of a part where it is now, not closed, shape (n, 3)."""
        return transform(self.poses[part.id], part.plane.lift(_corners(part.polygon)))

    def flap_outline(self, flap: Flap, carrier: Part) -> FloatArray:
        """Corners of a flap where it is now, not closed, shape (n, 3)."""
        return transform(self.flaps[flap_key(flap)], carrier.plane.lift(_corners(flap.polygon)))


def _corners(polygon: object) -> FloatArray:
    import shapely

    corners: FloatArray = shapely.get_coordinates(shapely.get_exterior_ring(polygon))[:-1]
    return corners

"""How a flap turns about its crease."""

from functools import cached_property

import numpy as np

from popsim.assembly.scene import FlapKey, flap_key
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import turns_about
from popsim.layout import Flap, Layout


class FlapMotion:
    """The crease of a flap and how far it turns, in the open pose.

    Attributes
    ----------
    flap:
        The flap.
    axis:
        Ends of its crease, shape (2, 3), mm.
    glued:
        Turn about the axis, right-handed, rad, that carries it from flat beside its carrier onto its place on the
        target, as both are in the open pose.
    """

    def __init__(self, flap: Flap, layout: Layout) -> None:
        carrier, target = layout.parts[flap.carrier], layout.parts[flap.target]
        self.flap = flap
        self.axis = carrier.plane.lift(flap.line)
        along = (self.axis[1] - self.axis[0]) / np.linalg.norm(self.axis[1] - self.axis[0])
        outward = _across(carrier.plane.lift(_middle(flap.polygon)) - self.axis[0], along)
        ahead = _across(target.plane.lift(_middle(flap.landing)) - self.axis[0], along)
        self.glued = float(np.arctan2(along @ np.cross(outward, ahead), outward @ ahead))

    @property
    def key(self) -> FlapKey:
        """Key of the flap in scenes."""
        return flap_key(self.flap)

    @cached_property
    def landed(self) -> FloatArray:
        """Motion (4, 4) of the flap onto its place, both in the open pose."""
        return self.turned(self.glued)

    def turned(self, angle: float) -> FloatArray:
        """Motion (4, 4) of the flap against its carrier in the open pose, turned by `angle`, rad."""
        along = self.axis[1] - self.axis[0]
        turn: FloatArray = turns_about(along / np.linalg.norm(along), self.axis[0], np.array([angle]))[0]
        return turn


def flap_motions(layout: Layout) -> dict[FlapKey, FlapMotion]:
    """The motions of all flaps of a layout, by key."""
    return {flap_key(flap): FlapMotion(flap, layout) for flap in layout.flaps}


def _middle(polygon: object) -> FloatArray:
    import shapely

    spot = shapely.centroid(polygon)
    return np.array([spot.x, spot.y])


def _across(offset: FloatArray, along: FloatArray) -> FloatArray:
    """Unit vector of `offset` without what runs along the crease."""
    across = offset - (offset @ along) * along
    return np.asarray(across / np.linalg.norm(across))

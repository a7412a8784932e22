"""Mountain or valley, as seen from the printed side."""

from enum import Enum

import numpy as np

from popsim.design import Hinge
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import left_of
from popsim.layout.contact import Contact
from popsim.layout.parts import Part

FLAT = 1e-3
"""Sine of the angle (0.06 degrees) below which two parts lie in one plane; the design says which way then."""


class Crease(Enum):
    """How paper bends at a line, seen from the printed side: away from the viewer or towards."""

    MOUNTAIN = "mountain"
    VALLEY = "valley"
    NONE = "none"


def into(part: Part, contact: Contact, side: int | None = None) -> FloatArray:
    """Unit direction (3,) from a contact into the paper of `part`; `side` 1 (left) or -1 where both have paper."""
    across = left_of(contact.ends) * (side if side is not None else (1 if contact.left else -1))
    return np.asarray(across[0] * part.plane.u + across[1] * part.plane.v)


def bend(normal: FloatArray, ahead: FloatArray, hinge: Hinge) -> Crease:
    """How paper with the printed side `normal` (3,) bends where it goes on in direction `ahead` (3,).

    It is convex, a mountain, where it turns away from the printed side. Where it goes on flat in the open pose,
    the crease vector of `hinge` points to the side on which it will bulge; the card itself closes to a valley.
    """
    rise = float(normal @ ahead)
    if abs(rise) > FLAT:
        return Crease.VALLEY if rise > 0 else Crease.MOUNTAIN
    if hinge.crease is None:
        return Crease.VALLEY if hinge.kind == "central" else Crease.MOUNTAIN
    return Crease.MOUNTAIN if normal @ np.array(hinge.crease) > 0 else Crease.VALLEY

"""A flap: what is cut, how it folds, and where it is glued."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from popsim.geometry.arrays import FloatArray
from popsim.layout.folding import Crease
from popsim.layout.joints import Joint
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry import Polygon


@dataclass(frozen=True, eq=False)
class Flap:
    """A flap as it is cut, and the place where it is glued.

    Attributes
    ----------
    joint, stretch:
        What it holds together, and the index of the stretch of that line.
    carrier, target:
        Ids of the part it is cut with and of the part it is glued to.
    polygon:
        Its outline in the carrier's flat coordinates.
    line:
        Where it meets the carrier, ends in the carrier's flat coordinates, shape (2, 2).
    crease:
        How it folds along that line, seen from the printed side.
    landing:
        Where it is glued, in the target's flat coordinates (seen from the printed side, whatever the face).
    face:
        Which face of the target is glued.
    glue_on_print:
        Whether the glue goes on the flap's printed side.
    opening:
        Of a flap in a slot, what is cut out of its carrier around it, in the carrier's flat coordinates: there the
        target passes through. None for a flap on an edge.
    """

    joint: Joint
    stretch: int
    carrier: str
    target: str
    polygon: "Polygon"
    line: FloatArray
    crease: Crease
    landing: "Polygon"
    face: Face
    glue_on_print: bool
    opening: "Polygon | None" = None

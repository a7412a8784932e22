"""Where on a plate the model will show once contours are cut."""

from dataclasses import dataclass

from popsim.fitting.fronts import Fronts
from popsim.fitting.kernels.records import Seen
from popsim.fitting.legs import legs, may_have_legs
from popsim.fitting.shape import Shape
from popsim.fitting.slant import ACROSS, Slant
from popsim.geometry.arrays import BoolArray, FloatArray

ALONG = 0.5
"""A plate whose normal makes a greater |cos| with y does not go on over the fold."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """A mask over the plane of a plate.

    Attributes
    ----------
    slant:
        The plane.
    low, grain:
        Corner where the cells start, and their sides, along the coordinates of the slant, mm, each of shape (2,).
    mask:
        In which cells the model shows, shape (n, m).
    face:
        Cells of the face of the plate, shape (n, m).
    """

    slant: Slant
    low: FloatArray
    grain: FloatArray
    mask: BoolArray
    face: BoolArray

    @staticmethod
    def of(plate: Shape, fronts: Fronts) -> "Stencil":
        """Hold a plate against a model.

        Within the face what lies no deeper shows, and what that encloses; beyond the face what lies near, but not
        what hangs in the air there or is but a seam along the face; and no legs. Patches inside show what both
        sides hide. Strips reach for hinges that hold nowhere else.
        """
        from popsim.fitting.kernels.stencils import held, shown, stencil

        slant = Slant.of(plate.outward, plate.outline[0])
        rings = slant.seen(plate.outline), slant.seen(plate.room), slant.seen(plate.hinges)
        seen = Seen(*rings, plate.taken, plate.behind, plate.beside, plate.principal)
        ends, walls = fronts.ends(slant.axis, slant.sign), _walls(plate, slant)
        plane = slant.level, *slant.slopes
        low, grain, mask, face, deepest = stencil(seen, ends, plane, walls)
        if may_have_legs(plate, deepest):
            own = held(seen, ends, plane)
            left_out = legs(plate, own)
            if left_out is not None:
                own = own._replace(face=own.face & ~left_out, beyond=own.beyond & ~left_out)
                mask = shown(own, fronts.pixel, seen, walls)
        return Stencil(slant, low, grain, mask, face)


def _walls(plate: Shape, slant: Slant) -> tuple[bool, int, float]:
    """Whether a plate stands upright; the coordinate that leads over the fold, -1 where it does not go on there.

    And, last, on which side of the fold it lies.
    """
    goes_on = abs(plate.outward[1]) < ALONG and 1 in ACROSS[slant.axis]
    coordinate = ACROSS[slant.axis].index(1) if goes_on else -1
    return not plate.lies, coordinate, sum(plate.outline[:, 1].tolist())

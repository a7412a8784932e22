"""Slots: how one part passes through another, and is held there.

Where a joint runs across the inside of both parts, no edge can carry a flap. One part, the host, gets an opening
on one side of the line, as long as the joint; a flap left standing in it, hinged on the line itself, folds up and
is glued to the part that was pushed through, the guest. The opening lets it in, and the crease lets both turn.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from popsim.geometry.flat import common, inverse, move_shape
from popsim.layout.contact import Contact
from popsim.layout.folding import FLAT, bend, into
from popsim.layout.joints import Joint
from popsim.layout.parts import Part
from popsim.layout.sites import Face, Site, glue_on_print, strip

if TYPE_CHECKING:
    from shapely.geometry import Polygon

NEAR = 0.05
"""mm; paper this near to a line lies on it."""

FAR = 1e5
"""mm; beyond all paper."""


def slot_sites(
    joint: Joint, stretch: int, parts: tuple[Part, Part], seen: tuple[Contact, Contact], play: float
) -> Iterator[Site]:
    """Sites of flaps in slots for a stretch that runs across the inside of both parts.

    Parameters
    ----------
    parts, seen:
        The two parts, and the stretch as they see it.
    play:
        How much longer than the joint its slot is at either end, mm.
    """
    if joint.hinge is None or not all(contact.left and contact.right for contact in seen):
        return
    for one, other in ((0, 1), (1, 0)):
        host, guest = parts[one], parts[other]
        for side in (1, -1):
            back = -into(host, seen[one], side)
            near = float(guest.plane.normal @ -back)
            if abs(near) < FLAT:
                continue  # they lie in one plane: nothing can pass
            face = Face.PRINTED if near > 0 else Face.REVERSE
            for up in (1, -1):
                ahead = into(guest, seen[other], up)
                site = Site(
                    joint=joint,
                    stretch=stretch,
                    carrier=host,
                    target=guest,
                    on_carrier=strip(seen[one].ends, side),
                    on_target=strip(seen[other].ends, up),
                    length=seen[one].length,
                    face=face,
                    crease=bend(host.plane.normal, ahead, joint.hinge),
                    glue_on_print=glue_on_print(host.plane.normal, back, ahead, face.value * guest.plane.normal),
                    rank=0 if face is Face.REVERSE or host.plane.normal @ ahead < -FLAT else 2,
                    slot=True,
                )
                if _goes_through(site, play):
                    yield site


def opening(length: float, depth: float, play: float) -> "Polygon":
    """The opening of a slot in strip coordinates, for a stretch of `length`, mm."""
    from shapely.geometry import box

    return box(-play, 0.0, length + play, depth)


def _goes_through(site: Site, play: float) -> bool:
    """Whether either half of the guest is nowhere wider than the slot, so that it can be pushed through."""
    import shapely

    moved = move_shape(inverse(site.on_target), site.target.polygon)
    line = shapely.LineString([(0.0, 0.0), (site.length, 0.0)])
    for half in (shapely.box(-FAR, 0.0, FAR, FAR), shapely.box(-FAR, -FAR, FAR, 0.0)):
        through = [piece for piece in shapely.get_parts(common(moved, half)) if piece.distance(line) < NEAR]
        ends = shapely.GeometryCollection(through).bounds
        if ends[0] >= -play and ends[2] <= site.length + play:
            return True
    return False

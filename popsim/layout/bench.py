"""The bench on which flaps are planned: what paper lies round each site before there is any flap."""

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common, inverse, left_of, move, move_shape, without
from popsim.layout.contact import BESIDE, Contact, contacts
from popsim.layout.flap_shape import APART
from popsim.layout.folding import into
from popsim.layout.joints import Joint
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.settings import LayoutSettings
from popsim.layout.sites import Face, Site, sites
from popsim.layout.slots import slot_sites

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

ON_LINE = 0.1
"""mm; what lies no farther beyond the line of a flap is no obstacle to it."""

ROUND = 2.0
"""mm; how far round a flap paper is looked for."""


class Bench:
    """Parts, nets and sites; everything here stays as it is while flaps are placed."""

    def __init__(
        self, parts: Mapping[str, Part], joints: tuple[Joint, ...], nets: tuple[Net, ...], settings: LayoutSettings
    ) -> None:
        self.parts = parts
        self.settings = settings
        folded = {joint.id for net in nets for joint in net.folds}
        self.open = tuple(joint for joint in joints if joint.id not in folded)
        self.net_of = {name: net for net in nets for name in net.motions}
        self.seen: dict[tuple[str, str], tuple[Contact, ...]] = {
            (joint.id, name): contacts(joint, parts[name]) for joint in joints for name in joint.parts
        }
        self.paper: dict[str, list[tuple[str, Polygon]]] = {}
        for net in nets:
            own = [(name, move_shape(motion, parts[name].polygon)) for name, motion in net.motions.items()]
            self.paper |= dict.fromkeys(net.motions, own)
        self.standing: dict[tuple[str, Face], list[FloatArray]] = {}
        for joint in joints:
            for name in joint.parts:
                self._stand(joint, name)
        self.blocked = cache(self._blocked)
        self.allowed = cache(self._allowed)

    def carriers(self) -> dict[str, tuple[str, ...]]:
        """The parts that can carry flaps of each joint that is no fold, by joint id."""
        return {
            joint.id: tuple(name for name in joint.parts if self._is_free(name, self.seen[joint.id, name][0]))
            for joint in self.open
        }

    def sites(self, joint: Joint, stretch: int) -> tuple[Site, ...]:
        """All sites of a stretch of a joint that is no fold."""
        first, second = joint.parts
        seen = (self.seen[joint.id, first][stretch], self.seen[joint.id, second][stretch])
        free = (self._is_free(first, seen[0]), self._is_free(second, seen[1]))
        alone = (self._is_alone(joint, first, seen[0]), self._is_alone(joint, second, seen[1]))
        pair = (self.parts[first], self.parts[second])
        return (
            *sites(joint, stretch, pair, seen, free, alone),
            *slot_sites(joint, stretch, pair, seen, self.settings.clearance),
        )

    def to_strip(self, site: Site) -> FloatArray:
        """Motion (3, 3) from the net of a site's carrier to strip coordinates."""
        name = site.carrier.id
        return inverse(self.net_of[name].motions[name] @ site.on_carrier)

    def lines_on(self, part: str, but: Joint) -> list[FloatArray]:
        """All stretches of joints at a part but those of one, in the part's flat coordinates, each (2, 2)."""
        return [
            contact.ends
            for (joint, name), stretches in self.seen.items()
            if name == part and joint != but.id
            for contact in stretches
        ]

    def _blocked(self, site: Site) -> "BaseGeometry":
        """Where the carrier's own net has paper, in strip coordinates, about where a flap can be."""
        import shapely

        near, to_strip = self._reach(site), self.to_strip(site)
        blocked = []
        for other, shape in self.paper[site.carrier.id]:
            moved = move_shape(to_strip, shape)
            if moved.intersects(near):
                grown = common(moved, near).buffer(APART)
                blocked.append(_above(grown, 2 * APART) if other == site.carrier.id else grown)
        return shapely.unary_union(blocked)

    def _allowed(self, site: Site, clearance: float) -> "BaseGeometry":
        """Where the target's face takes a flap, in strip coordinates, about where a flap can be."""
        import shapely

        to_strip = inverse(site.on_target)
        target = move_shape(to_strip, site.target.polygon)
        near = self._reach(site)
        rim = common(_off_line(target.boundary), near.buffer(clearance)).buffer(clearance)
        lines = [move(to_strip, line) for line in self.standing.get((site.target.id, site.face), [])]
        standing = [off_line(line, clearance) for line in lines]
        return without(common(target, near), shapely.unary_union([rim, *standing]))

    def _reach(self, site: Site) -> "Polygon":
        from shapely.geometry import box

        deepest = max(self.settings.flap_depth, self.settings.seam_depth)
        return box(-ROUND, -ROUND, site.length + ROUND, deepest + ROUND)

    def _is_free(self, name: str, contact: Contact) -> bool:
        """Whether a contact is a cut edge of the net: nothing else of the net lies beyond it."""
        from shapely.geometry import Polygon

        if not contact.is_edge:
            return False
        across = BESIDE * left_of(contact.ends) * (-1 if contact.left else 1)
        strip = Polygon([contact.ends[0], contact.ends[1], contact.ends[1] + across, contact.ends[0] + across])
        moved = move_shape(self.net_of[name].motions[name], strip)
        return all(
            common(moved, shape).area < moved.area / 2 for other, shape in self.paper[name] if other != name
        )

    def _is_alone(self, joint: Joint, name: str, contact: Contact) -> bool:
        """Whether no other joint holds the part along a contact, so that a flap can go round its edge."""
        from shapely.geometry import LineString

        beside = LineString(contact.ends).buffer(BESIDE)
        return not any(
            beside.intersection(LineString(line)).length > 2 * BESIDE for line in self.lines_on(name, joint)
        )

    def _stand(self, joint: Joint, name: str) -> None:
        """Remember the lines on which other parts stand inside a face of part `name`."""
        if joint.hinge is None:
            return
        part, other = self.parts[name], self.parts[joint.other(name)]
        pairs = zip(self.seen[joint.id, name], self.seen[joint.id, other.id], strict=True)
        for own, theirs in pairs:
            if own.left and own.right:
                for side, paper in ((1, theirs.left), (-1, theirs.right)):
                    if paper:
                        rise = float(part.plane.normal @ into(other, theirs, side))
                        face = Face.PRINTED if rise > 0 else Face.REVERSE
                        self.standing.setdefault((name, face), []).append(own.ends)


def off_line(line: FloatArray, clearance: float) -> "BaseGeometry":
    """What a line (2, 2) in strip coordinates takes from a flap; nothing where it is the flap's own."""
    import shapely

    if line[:, 1].max() <= ON_LINE:
        return shapely.Polygon()
    return shapely.LineString(line).buffer(clearance)


def _above(shape: "BaseGeometry", height: float) -> "BaseGeometry":
    """`shape` without the band of +-`height` about the line of the flap."""
    from shapely.geometry import box

    low, bottom, high, top = shape.bounds
    return without(shape, box(low - 1, -height, high + 1, height)) if bottom < top else shape


def _off_line(boundary: "BaseGeometry") -> "BaseGeometry":
    """The part of a boundary on the flap's side, without what runs along its line."""
    from shapely.geometry import box

    low, _, high, top = boundary.bounds
    return boundary.intersection(box(low - 1, ON_LINE, high + 1, max(top, ON_LINE) + 1))

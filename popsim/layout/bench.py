"""The bench on which flaps are planned: what paper lies where, and what is left of a flap at a site."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common, inverse, left_of, move, move_shape, without
from popsim.layout.contact import BESIDE, Contact, contacts
from popsim.layout.flap import Flap
from popsim.layout.flap_shape import APART, crease_span, tab, trapezoid, trimmed
from popsim.layout.folding import into
from popsim.layout.joints import Joint
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.settings import LayoutSettings
from popsim.layout.sites import Face, Site, sites
from popsim.layout.slots import opening, slot_sites

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

ENOUGH = (0.7, 0.35, 0.1)
"""Shares of the full flap; a site with more beats one with less, whatever else speaks for it."""

ON_LINE = 0.1
"""mm; what lies no farther beyond the line of a flap is no obstacle to it."""

SMALLEST = 1.0
"""mm^2; glue on less holds nothing."""


class Bench:
    """What lies where while flaps are planned: paper per net, landings per face of each part."""

    def __init__(
        self,
        parts: Mapping[str, Part],
        joints: tuple[Joint, ...],
        nets: tuple[Net, ...],
        settings: LayoutSettings,
    ) -> None:
        self.parts = parts
        self.settings = settings
        folded = {joint.id for net in nets for joint in net.folds}
        self.open = tuple(joint for joint in joints if joint.id not in folded)
        self.net_of = {name: net for net in nets for name in net.motions}
        self.seen: dict[tuple[str, str], tuple[Contact, ...]] = {
            (joint.id, name): contacts(joint, parts[name]) for joint in joints for name in joint.parts
        }
        self.paper: dict[str, list[tuple[str, BaseGeometry]]] = {}
        for net in nets:
            own = [(name, move_shape(motion, parts[name].polygon)) for name, motion in net.motions.items()]
            self.paper |= dict.fromkeys(net.motions, own)
        self.landed: dict[tuple[str, Face], list[BaseGeometry]] = {}
        self.standing: dict[tuple[str, Face], list[FloatArray]] = {}
        for joint in joints:
            for name in joint.parts:
                self._stand(joint, name)

    def carriers(self) -> dict[str, tuple[str, ...]]:
        """The parts that can carry flaps of each joint that is no fold, by joint id."""
        return {
            joint.id: tuple(name for name in joint.parts if self._is_free(name, self.seen[joint.id, name][0]))
            for joint in self.open
        }

    def sites(self, joint: Joint, stretch: int) -> list[Site]:
        first, second = joint.parts
        seen = (self.seen[joint.id, first][stretch], self.seen[joint.id, second][stretch])
        free = (self._is_free(first, seen[0]), self._is_free(second, seen[1]))
        alone = (self._is_alone(joint, first, seen[0]), self._is_alone(joint, second, seen[1]))
        pair = (self.parts[first], self.parts[second])
        return [
            *sites(joint, stretch, pair, seen, free, alone),
            *slot_sites(joint, stretch, pair, seen, self.settings.clearance),
        ]

    def place(self, choices: tuple[Site, ...], depths: Mapping[str, float]) -> Flap | None:
        """The best flap among `choices`, which then takes up its room; None where nothing of use fits."""
        settings = self.settings
        for form, clearance in ((trapezoid, settings.clearance), (tab, settings.clearance / 5)):
            options = []
            for order, site in enumerate(choices):
                deep = site.joint.hinge is None or site.joint.hinge.kind == "central"
                full = form(site.length, settings.seam_depth if deep else depths[site.target.id])
                shape = trimmed(full, self._blocked(site, full), self._allowed(site, full, clearance))
                if shape is None or shape.area < max(ENOUGH[-1] * full.area, SMALLEST):
                    continue
                share = sum(shape.area < enough * full.area for enough in ENOUGH)
                crowd = len(self.net_of[site.carrier.id].motions)
                options.append(((share, site.rank, crowd, -round(shape.area, 3), order), site, shape))
            if options:
                _, site, shape = min(options, key=lambda option: option[0])
                return self._keep(site, shape)
        return None

    def _keep(self, site: Site, shape: "Polygon") -> Flap:
        low, high = crease_span(shape)
        landing = move_shape(site.on_target, shape)
        polygon = move_shape(site.on_carrier, shape)
        hole = None
        if site.slot:
            hole = move_shape(site.on_carrier, self._opening(site, shape))
            for face in Face:
                self.landed.setdefault((site.carrier.id, face), []).append(hole)
        else:
            motion = self.net_of[site.carrier.id].motions[site.carrier.id]
            self.paper[site.carrier.id].append((f"flap {site.joint.id}", move_shape(motion, polygon)))
        self.landed.setdefault((site.target.id, site.face), []).append(landing)
        return Flap(
            joint=site.joint,
            stretch=site.stretch,
            carrier=site.carrier.id,
            target=site.target.id,
            polygon=polygon,
            line=move(site.on_carrier, np.array([[low, 0.0], [high, 0.0]])),
            crease=site.crease,
            landing=landing,
            face=site.face,
            glue_on_print=site.glue_on_print,
            opening=hole,
        )

    def _opening(self, site: Site, flap: "Polygon") -> "Polygon":
        """What is cut out round a flap in a slot, in strip coordinates."""
        return opening(site.length, flap.bounds[3] + APART, self.settings.clearance)

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

        line = LineString(contact.ends)
        return not any(
            line.buffer(BESIDE).intersection(LineString(own.ends)).length > 2 * BESIDE
            for (other, part), stretches in self.seen.items()
            if part == name and other != joint.id
            for own in stretches
        )

    def _blocked(self, site: Site, full: "Polygon") -> "BaseGeometry":
        """Where the carrier's own piece has paper, in strip coordinates; for a slot, all if there is no room."""
        import shapely

        if site.slot:
            hole = move_shape(site.on_carrier, self._opening(site, full))
            return shapely.Polygon() if self._can_open(site.carrier, hole, site.joint) else full
        name = site.carrier.id
        to_strip = inverse(self.net_of[name].motions[name] @ site.on_carrier)
        near = full.buffer(2 * APART)
        blocked = []
        for other, shape in self.paper[name]:
            moved = move_shape(to_strip, shape)
            if moved.intersects(near):
                blocked.append(_above(moved.buffer(APART), 2 * APART) if other == name else moved.buffer(APART))
        return shapely.unary_union(blocked)

    def _can_open(self, host: Part, hole: "Polygon", own: Joint) -> bool:
        """Whether an opening in a part keeps off its rim, what is glued to it, and its other joints."""
        import shapely

        clearance = self.settings.clearance
        lines = [
            shapely.LineString(contact.ends)
            for (joint, part), stretches in self.seen.items()
            if part == host.id and joint != own.id
            for contact in stretches
        ]
        landings = [shape for face in Face for shape in self.landed.get((host.id, face), [])]
        return bool(
            host.polygon.contains(hole)
            and shapely.distance(hole, [host.polygon.boundary, *lines, *landings]).min() >= clearance
        )

    def _allowed(self, site: Site, full: "Polygon", clearance: float) -> "BaseGeometry":
        """Where the target's face is free, in strip coordinates."""
        import shapely

        to_strip = inverse(site.on_target)
        target = move_shape(to_strip, site.target.polygon)
        rim = _off_line(target.boundary).buffer(clearance)
        key = (site.target.id, site.face)
        landed = [move_shape(to_strip, shape).buffer(APART) for shape in self.landed.get(key, [])]
        lines = [move(to_strip, line) for line in self.standing.get(key, [])]
        standing = [shapely.LineString(line).buffer(clearance) for line in lines if line[:, 1].max() > ON_LINE]
        return common(without(target, shapely.unary_union([rim, *landed, *standing])), full.envelope)

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

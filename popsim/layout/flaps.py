"""Flaps for all joints that are no folds: which part carries each, how it is shaped, where it lands (Sec. 4.4).

All is planned before pieces are placed on sheets. For each stretch of each glue joint every site is tried: the
flap is trimmed to stay off its own piece and its other flaps, and inside its target, off what else lands or stands
there. The site that leaves most of the flap wins, a hidden one first.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common, inverse, left_of, move, move_shape, without
from popsim.layout.contact import BESIDE, Contact, contacts
from popsim.layout.flap_shape import APART, CLEARANCE, crease_span, tab, trapezoid, trimmed
from popsim.layout.folding import Crease, into
from popsim.layout.joints import Joint
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.settings import LayoutSettings
from popsim.layout.sites import Face, Site, sites
from popsim.layout.teeth import share_edges

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

ENOUGH = (0.7, 0.35, 0.1)
"""Shares of the full flap; a site with more beats one with less, whatever else speaks for it."""

ON_LINE = 0.1
"""mm; what lies no farther beyond the line of a flap is no obstacle to it."""

SMALLEST = 1.0
"""mm^2; glue on less holds nothing."""

ROUNDS = 5
"""Times that flaps are made shallower where no room was left for one."""


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


class Task(NamedTuple):
    """One stretch of a glue joint, with the sites that it can choose from."""

    joint: Joint
    stretch: int
    choices: tuple[Site, ...]

    @property
    def freedom(self) -> tuple[int, int]:
        """How much there is to choose from; who has least goes first."""
        return len({site.carrier.id for site in self.choices}), len(self.choices)


def plan_flaps(
    parts: Mapping[str, Part], joints: tuple[Joint, ...], nets: tuple[Net, ...], settings: LayoutSettings
) -> tuple[tuple[Flap, ...], tuple[Joint, ...]]:
    """Return the flaps of all joints that are no folds of `nets`, in their order, and the joints left over.

    Stretches of joints that must share an edge are divided among them. A joint is left over where no flap of use
    fits on any side.
    """
    joints = share_edges(joints, _Bench(parts, joints, nets).carriers())
    depths = dict.fromkeys(parts, settings.flap_depth)
    for _ in range(ROUNDS):
        flaps, left = _plan(_Bench(parts, joints, nets), depths, settings)
        if not left:
            break
        # whatever lands where room ran out gets half as deep, to leave some for all
        depths |= {name: depths[name] / 2 for name in sorted({name for joint in left for name in joint.parts})}
    return flaps, left


def _plan(
    bench: "_Bench", depths: Mapping[str, float], settings: LayoutSettings
) -> tuple[tuple[Flap, ...], tuple[Joint, ...]]:
    """One round of planning with the given depth of flaps by the part that they land on."""
    tasks = [
        Task(joint, k, tuple(bench.sites(joint, k))) for joint in bench.open for k in range(len(joint.stretches))
    ]
    found: dict[tuple[str, int], Flap] = {}
    for task in sorted(tasks, key=lambda task: task.freedom):
        flap = bench.place(task.choices, depths, settings)
        if flap is not None:
            found[task.joint.id, task.stretch] = flap
    flaps = tuple(found[key] for task in tasks if (key := (task.joint.id, task.stretch)) in found)
    held = {flap.joint.id for flap in flaps}
    left = {task.joint.id: task.joint for task in tasks if task.joint.id not in held}
    return flaps, tuple(left.values())


class _Bench:
    """What lies where while flaps are planned: paper per net, landings per face of each part."""

    def __init__(self, parts: Mapping[str, Part], joints: tuple[Joint, ...], nets: tuple[Net, ...]) -> None:
        self.parts = parts
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
        return list(sites(joint, stretch, (self.parts[first], self.parts[second]), seen, free, alone))

    def place(
        self, choices: tuple[Site, ...], depths: Mapping[str, float], settings: LayoutSettings
    ) -> Flap | None:
        """The best flap among `choices`, which then takes up its room; None where nothing of use fits."""
        for form, clearance in ((trapezoid, CLEARANCE), (tab, CLEARANCE / 5)):
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
        net = self.net_of[site.carrier.id]
        self.paper[site.carrier.id].append(
            (f"flap {site.joint.id}", move_shape(net.motions[site.carrier.id], polygon))
        )
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
        )

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
        """Where the carrier's own piece has paper, in strip coordinates."""
        import shapely

        name = site.carrier.id
        to_strip = inverse(self.net_of[name].motions[name] @ site.on_carrier)
        near = full.buffer(2 * APART)
        blocked = []
        for other, shape in self.paper[name]:
            moved = move_shape(to_strip, shape)
            if moved.intersects(near):
                blocked.append(_above(moved.buffer(APART), 2 * APART) if other == name else moved.buffer(APART))
        return shapely.unary_union(blocked)

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
                side = float(part.plane.normal @ into(other, theirs))
                face = Face.PRINTED if side > 0 else Face.REVERSE
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

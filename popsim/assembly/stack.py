"""The folded pop-up as a stack of paper: which part lies over which, and what lies over the place of a flap."""

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from popsim.assembly.kit import Kit
from popsim.assembly.reference import STACKED
from popsim.assembly.scene import FlapKey, flap_key
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common
from popsim.geometry.rigid import transform

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

OVERLAP = 0.5
"""mm^2; parts that share less lie beside each other."""

SAME = 0.02
"""mm; planes nearer than this where they overlap are one: neither lies on the other."""

RIM = 0.5
"""mm by which the place of a flap is taken in before it is asked what lies on it."""

Over = dict[str, frozenset[str]]


class Stack:
    """All parts as they lie when the card is nearly closed, seen across the card.

    Attributes
    ----------
    kit:
        What is put together.
    over:
        The parts that lie over each part, by its id, with the ground on top.
    under:
        Those that lie under it.
    covers:
        The parts that lie on the place of each flap, on the face it is glued to, by its key.
    """

    def __init__(self, kit: Kit) -> None:
        self.kit = kit
        over: dict[str, set[str]] = {name: set() for name in kit.layout.parts}
        under: dict[str, set[str]] = {name: set() for name in kit.layout.parts}
        for first, second, shared in self._overlaps(list(self._shapes.values()), list(self._shapes)):
            rise = self.rise(first, second, shared)
            if abs(rise) > SAME:
                upper, lower = (first, second) if rise > 0 else (second, first)
                over[lower].add(upper)
                under[upper].add(lower)
        self.over: Over = {name: frozenset(names) for name, names in over.items()}
        self.under: Over = {name: frozenset(names) for name, names in under.items()}
        self.covers = self._covers()

    @cached_property
    def masks(self) -> dict[int, list[int]]:
        """The parts over (1) and under (-1) each part, as masks of the kit's roll."""
        return {
            side: self.kit.roll.relation((name, other) for name in on for other in on[name])
            for side, on in ((1, self.over), (-1, self.under))
        }

    def side(self, key: FlapKey) -> int:
        """1 where a flap lies on the upper face of its target, else -1."""
        flap = self.kit.flap_motions[key].flap
        up = self.kit.reference.flat[flap.target][:3, :3] @ self.kit.face(flap) @ STACKED
        return 1 if up > 0 else -1

    def mouth(self, key: FlapKey) -> tuple[frozenset[str], frozenset[str]]:
        """The parts over and under the carrier of a flap where the flap goes in, if it is tucked to its place."""
        import shapely

        flap = self.kit.flap_motions[key].flap
        place = self._seen(flap.target, flap.landing.buffer(-RIM))
        line = shapely.get_coordinates(self._seen(flap.carrier, shapely.LineString(flap.line)))
        along = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
        turn = 2 * np.outer(along, along) - np.eye(2)
        outside = shapely.transform(place, lambda spots: (spots - line[0]) @ turn + line[0])
        most = outside.area / 2
        near = {name for name, shape in self._shapes.items() if shape.intersection(outside).area > most}
        return self.over[flap.carrier] & near, self.under[flap.carrier] & near

    def rise(self, first: str, second: str, shared: "BaseGeometry") -> float:
        """How high the first part lies over the second where their difference is greatest, mm."""
        import shapely

        spots = shapely.get_coordinates(shared)
        apart = self._heights(first, spots) - self._heights(second, spots)
        return float(apart[np.abs(apart).argmax()])

    @cached_property
    def _shapes(self) -> dict[str, "BaseGeometry"]:
        """Outlines of all parts, seen across the card, by id."""
        return {name: self._seen(name, outline.polygon) for name, outline in self.kit.outlines.items()}

    def _seen(self, name: str, flat: "BaseGeometry") -> "BaseGeometry":
        """A shape in the flat coordinates of a part, seen across the card."""
        import shapely

        plane, pose = self.kit.layout.parts[name].plane, self.kit.reference.flat[name]
        return shapely.transform(flat, lambda spots: transform(pose, plane.lift(spots))[:, [0, 2]])

    def _heights(self, name: str, spots: FloatArray) -> FloatArray:
        """Heights of a part at spots (n, 2), mm."""
        plane = self.kit.layout.parts[name].plane.moved(self.kit.reference.flat[name])
        normal, origin = plane.normal, plane.origin
        along = (spots - origin[[0, 2]]) @ normal[[0, 2]]
        return np.asarray(origin[1] - along / normal[1])

    def _overlaps(self, shapes: list["BaseGeometry"], names: list[str]) -> list[tuple[str, str, "BaseGeometry"]]:
        import shapely

        first, second = shapely.STRtree(shapes).query(shapes, predicate="intersects")
        found = []
        for a, b in sorted(zip(first.tolist(), second.tolist(), strict=True)):
            if a < b:
                shared = common(shapes[a], shapes[b])
                if shared.area > OVERLAP:
                    found.append((names[a], names[b], shared))
        return found

    def _covers(self) -> dict[FlapKey, frozenset[str]]:
        import shapely

        names = list(self._shapes)
        tree = shapely.STRtree(list(self._shapes.values()))
        found = {}
        for key, motion in self.kit.flap_motions.items():
            flap = motion.flap
            place = self._seen(flap.target, flap.landing.buffer(-RIM))
            on = self.over if self.side(key) > 0 else self.under
            near = {names[k] for k in tree.query(place, predicate="intersects")}
            found[flap_key(flap)] = frozenset(near & on[flap.target])
        return found

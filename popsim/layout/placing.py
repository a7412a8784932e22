"""Placing flaps one after the other, each where most of it finds room."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.flat import inverse, move, move_shape, without
from popsim.layout.bench import Bench, off_line
from popsim.layout.flap import Flap
from popsim.layout.flap_shape import APART, crease_span, tab, trapezoid, trimmed
from popsim.layout.keep_off import KeepOff
from popsim.layout.sites import Face, Site
from popsim.layout.slots import opening

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

ENOUGH = (0.7, 0.35, 0.1)
"""Shares of the full flap; a site with more beats one with less, whatever else speaks for it."""

SMALLEST = 1.0
"""mm^2; glue on less holds nothing."""


class Placing:
    """Flaps placed so far: paper that they add to their nets, and room that they take where they land."""

    def __init__(self, bench: Bench, depths: Mapping[str, float], keep_off: tuple[KeepOff, ...]) -> None:
        self._bench = bench
        self._depths = depths
        self._tabs: dict[int, list[Polygon]] = {}
        self._landed: dict[tuple[str, Face], list[Polygon]] = {}
        self._off: dict[tuple[str, Face], list[KeepOff]] = {}
        for entry in keep_off:
            self._off.setdefault((entry.part, entry.face), []).append(entry)

    def place(self, choices: tuple[Site, ...]) -> Flap | None:
        """The best flap among `choices`, which then takes up its room; None where nothing of use fits."""
        clearance = self._bench.settings.clearance
        ranked = sorted((self._merit(site), order, site) for order, site in enumerate(choices))
        for form, kept in ((trapezoid, clearance), (tab, clearance / 5)):
            best: tuple[tuple[int, tuple[int, int], float, int], Site, Polygon] | None = None
            for merit, order, site in ranked:
                if best is not None and best[0][:2] < (0, merit):
                    break  # nothing that is left could be better
                full = form(site.length, self._depth(site))
                shape = trimmed(full, self._blocked(site, full), self._allowed(site, kept))
                if shape is None or shape.area < max(ENOUGH[-1] * full.area, SMALLEST):
                    continue
                share = sum(shape.area < enough * full.area for enough in ENOUGH)
                key = share, merit, -round(shape.area, 3), order
                if best is None or key < best[0]:
                    best = key, site, shape
            if best is not None:
                return self._keep(*best[1:])
        return None

    def _merit(self, site: Site) -> tuple[int, int]:
        """How well a flap at a site hides, and how many parts its net has; less is better."""
        return site.rank, len(self._bench.net_of[site.carrier.id].motions)

    def _depth(self, site: Site) -> float:
        if site.joint.hinge is None or site.joint.hinge.kind == "central":
            return self._bench.settings.seam_depth
        return self._depths[site.target.id]

    def _keep(self, site: Site, shape: "Polygon") -> Flap:
        low, high = crease_span(shape)
        landing = move_shape(site.on_target, shape)
        polygon = move_shape(site.on_carrier, shape)
        hole = None
        if site.slot:
            hole = move_shape(site.on_carrier, self._opening(site, shape))
            for face in Face:
                self._landed.setdefault((site.carrier.id, face), []).append(hole)
        else:
            net = self._bench.net_of[site.carrier.id]
            self._tabs.setdefault(id(net), []).append(move_shape(net.motions[site.carrier.id], polygon))
        self._landed.setdefault((site.target.id, site.face), []).append(landing)
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

    def _blocked(self, site: Site, full: "Polygon") -> "BaseGeometry":
        """Where the carrier's own piece has paper, in strip coordinates; for a slot, all if there is no room."""
        import shapely

        if site.slot:
            hole = move_shape(site.on_carrier, self._opening(site, full))
            return shapely.Polygon() if self._can_open(site, hole) else full
        to_strip, near = self._bench.to_strip(site), full.buffer(2 * APART)
        tabs = [move_shape(to_strip, tab) for tab in self._tabs.get(id(self._bench.net_of[site.carrier.id]), [])]
        grown = [shape.buffer(APART) for shape in tabs if shape.intersects(near)]
        return shapely.unary_union([self._bench.blocked(site), *grown])

    def _allowed(self, site: Site, clearance: float) -> "BaseGeometry":
        """Where the target's face is free, in strip coordinates."""
        import shapely

        key, to_strip = (site.target.id, site.face), inverse(site.on_target)
        landed = [move_shape(to_strip, shape).buffer(APART) for shape in self._landed.get(key, [])]
        off = [off_line(move(to_strip, entry.line), clearance) for entry in self._off.get(key, [])]
        free = self._bench.allowed(site, clearance)
        return without(free, shapely.unary_union([*landed, *off])) if landed or off else free

    def _opening(self, site: Site, flap: "Polygon") -> "Polygon":
        """What is cut out round a flap in a slot, in strip coordinates."""
        return opening(site.length, flap.bounds[3] + APART, self._bench.settings.clearance)

    def _can_open(self, site: Site, hole: "Polygon") -> bool:
        """Whether an opening keeps off the rim of its part, what is glued to it, and its other joints."""
        import shapely

        host = site.carrier
        lines = [shapely.LineString(line) for line in self._bench.lines_on(host.id, site.joint)]
        landings = [shape for face in Face for shape in self._landed.get((host.id, face), [])]
        apart = shapely.distance(hole, [host.polygon.boundary, *lines, *landings]).min()
        return bool(host.polygon.contains(hole) and apart >= self._bench.settings.clearance)

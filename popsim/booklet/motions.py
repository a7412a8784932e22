"""Where things come from and along which lines they move in a step."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from popsim.assembly import Step, flap_key
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.layout import Layout

if TYPE_CHECKING:
    from popsim.rendering.view import View

POINTS = 12
"""Points of an arrow at most."""

FROM = 25.0
"""mm beyond its crease from which the arrow of a flap comes that is slid in where all else keeps still."""


def tracks(step: Step, layout: Layout, view: "View") -> tuple[FloatArray, ...]:
    """Lines in plane coordinates, each (n, 2), of what moves: glued flaps or their places, else one part.

    Where nothing moves but flaps that are tucked between layers, these come from beyond their creases.
    """
    found = list(_of_flaps(step, layout)) or list(_of_parts(step, layout)) or list(_of_tucked(step, layout))
    return tuple(view.to_plane(track)[:, :2] for track in found)


def _of_flaps(step: Step, layout: Layout) -> Iterator[FloatArray]:
    for flap in layout.flaps:
        if flap_key(flap) not in step.flaps:
            continue
        landing = layout.parts[flap.target].plane.lift(np.array(flap.landing.centroid.coords[0]))
        for name in (flap.carrier, flap.target):
            if name in step.motion:
                yield _track(step.motion[name], landing)
                break


def _of_parts(step: Step, layout: Layout) -> Iterator[FloatArray]:
    """The way of the middle of that part which goes farthest."""
    ways = []
    for name, poses in step.motion.items():
        part = layout.parts[name]
        ways.append(_track(poses, part.plane.lift(np.array(part.polygon.centroid.coords[0]))))
    if ways:
        yield max(ways, key=lambda way: round(float(np.linalg.norm(way[-1] - way[0])), 6))


def _of_tucked(step: Step, layout: Layout) -> Iterator[FloatArray]:
    if step.before is None:
        return
    for flap in layout.flaps:
        if flap_key(flap) in step.flaps:
            place = layout.parts[flap.target].plane.lift(np.array(flap.landing.centroid.coords[0]))
            start, end = layout.parts[flap.carrier].plane.lift(flap.line)
            along = (end - start) / np.linalg.norm(end - start)
            foot = start + (place - start) @ along * along
            way = np.array([foot - FROM * (place - foot) / np.linalg.norm(place - foot), place])
            yield transform(step.before.poses[flap.target], way)


def _track(poses: FloatArray, point: FloatArray) -> FloatArray:
    """The way of a point of the open pose, shape (n, 3)."""
    picked = np.unique(np.linspace(0, len(poses) - 1, POINTS).round().astype(int))
    return transform(poses[picked], point[None])[:, 0]

"""Which of several papers in one plane lies on top: they are drawn as a stack that is a little thick.

Paper does not pass through paper on the way from the open pop-up to a flat state. So a part lies on that side of
another on which it is in the open pose, and of two that are in one plane there the crease says how they close.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from popsim.assembly import Scene
from popsim.booklet.cutout import Cutout
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move_shape
from popsim.geometry.plane import Plane
from popsim.layout import Layout, Part

LAYER = 0.2
"""mm between papers that lie on each other; flaps that are glued between them find room."""

LEVEL, NEAR = 0.99995, 0.2
"""Cosine between normals and mm between planes of parts that lie on each other."""

OVERLAP = 1.0
"""mm^2; parts that share less lie beside each other."""

ASIDE = 0.5
"""mm; parts nearer than this to the plane of another in the open pose are on neither side of it."""

UNSURE = 1e-3
"""Weight of a part that is on both sides of another."""


class Contact(NamedTuple):
    """Two parts that lie on each other: the upper, the lower, and how sure that is, mm."""

    upper: str
    lower: str
    sureness: float


def stacked(scene: Scene, layout: Layout, cutouts: dict[str, Cutout]) -> dict[str, FloatArray]:
    """Shift (3,) of each part of a scene, mm, by id, that makes a stack of what lies in one plane."""
    import networkx

    planes = {name: layout.parts[name].plane.moved(pose) for name, pose in scene.poses.items()}
    graph = networkx.DiGraph()
    graph.add_nodes_from(planes)
    for contact in sorted(_contacts(planes, layout, cutouts), key=lambda contact: -contact.sureness):
        if not networkx.has_path(graph, contact.upper, contact.lower):
            graph.add_edge(contact.lower, contact.upper)
    height: dict[str, int] = {}
    for name in networkx.topological_sort(graph):
        height[name] = 1 + max((height[lower] for lower in graph.predecessors(name)), default=-1)
    return {name: LAYER * height[name] * _up(plane.normal) for name, plane in planes.items()}


def _contacts(planes: dict[str, Plane], layout: Layout, cutouts: dict[str, Cutout]) -> Iterator[Contact]:
    creases = {frozenset(joint.parts): joint.hinge for joint in layout.joints if joint.hinge is not None}
    for first, second in _level(planes):
        one, other = planes[first], planes[second]
        spots = one.flat(np.array([other.origin, other.origin + other.u, other.origin + other.v]))
        motion = np.eye(3)
        motion[:2] = np.stack([spots[1] - spots[0], spots[2] - spots[0], spots[0]], axis=1)
        if cutouts[first].shape.intersection(move_shape(motion, cutouts[second].shape)).area < OVERLAP:
            continue
        hinge = creases.get(frozenset((first, second)))
        crease = None if hinge is None or hinge.crease is None else np.array(hinge.crease)
        yield _ordered(layout.parts[first], layout.parts[second], one, other, crease)


def _level(planes: dict[str, Plane]) -> Iterator[tuple[str, str]]:
    """Pairs of parts in one plane."""
    names = list(planes)
    normals = np.array([plane.normal for plane in planes.values()])
    origins = np.array([plane.origin for plane in planes.values()])
    away = np.abs(origins @ normals.T - np.einsum("ij,ij->i", origins, normals))
    for first, second in np.argwhere(np.triu((np.abs(normals @ normals.T) > LEVEL) & (away.T < NEAR), 1)):
        yield names[first], names[second]


def _ordered(first: Part, second: Part, one: Plane, other: Plane, crease: FloatArray | None) -> Contact:
    """Which of two parts is on top; the second where nothing tells."""
    rise = _side(second, first, crease) * _sign(one) - _side(first, second, crease) * _sign(other)
    if rise >= 0:
        return Contact(second.id, first.id, rise)
    return Contact(first.id, second.id, -rise)


def _side(part: Part, base: Part, crease: FloatArray | None) -> float:
    """How far a part is on the printed side of another in the open pose, mm; negative on the reverse.

    Next to nothing where it is on both.
    """
    corners = part.plane.lift(np.array(part.polygon.exterior.coords))
    away = base.plane.distance(corners)
    if np.abs(away).max() < ASIDE:
        return 0.0 if crease is None else -float(np.sqrt(part.polygon.area)) * float(crease @ base.plane.normal)
    both = away.min() < -ASIDE and away.max() > ASIDE
    return float(away.mean()) * (UNSURE if both else 1.0)


def _sign(plane: Plane) -> float:
    """1 where the printed side is that of the stack's upper side, else -1."""
    return 1.0 if plane.normal @ _up(plane.normal) > 0 else -1.0


def _up(normal: FloatArray) -> FloatArray:
    """Of both directions across a plane the one that counts as up: the same for all papers of a stack."""
    main = int(np.abs(normal).round(3).argmax())
    return np.asarray(normal * np.sign(normal[main]))

"""Which parts become one piece of paper: unfolding across folds, as many as possible (Sec. 4.4).

A net is a set of parts unfolded into one plane. Every fold of the design that is not inside a net becomes a glue
joint with a flap, so the best nets hold the most folds. That is a search for a spanning forest of the hinge graph
in which no net overlaps itself or exceeds the sheet: Kruskal's algorithm over several orders of the folds, of
which the best result is kept. A loop of folds opens where that costs least.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from random import Random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape, segment_motion
from popsim.layout.contact import contacts
from popsim.layout.joints import Joint
from popsim.layout.parts import Part
from popsim.layout.too_large import fits

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

TRIES = 40
"""Orders tried per group of parts; the gain beyond is nil on boxes with four tops and five pairs."""

OVERLAP = 0.05
"""mm; parts may run into each other by twice this where outlines are not exact."""

GoesOn = Callable[["BaseGeometry"], bool]
"""Whether a shape goes onto a sheet with flaps round it."""

COINCIDE = 0.02
"""mm; a second fold between parts of a net is a crease too where both unfold to one line as exactly as this."""


@dataclass(frozen=True, eq=False)
class Net:
    """Parts unfolded into one plane, printed sides up.

    Attributes
    ----------
    motions:
        Flat motion (3, 3) of each part into the net, by part id, in the order of the design.
    folds:
        The joints that are creases of the net.
    """

    motions: Mapping[str, FloatArray]
    folds: tuple[Joint, ...]


class Fold(NamedTuple):
    """A joint that can be a crease, with its two ends in the flat coordinates of both parts, shapes (2, 2)."""

    joint: Joint
    ends: tuple[FloatArray, FloatArray]


def find_nets(
    parts: tuple[Part, ...],
    joints: tuple[Joint, ...],
    room: tuple[float, float],
    allowance: float,
    barred: frozenset[str] = frozenset(),
    *,
    grain: bool = False,
) -> tuple[Net, ...]:
    """Return the nets of `parts`, ordered by their first part.

    Parameters
    ----------
    room, allowance:
        Width and height of the sheet, and how much flaps may add to a net's size, mm.
    barred:
        Ids of joints that shall be no folds.
    grain:
        Whether nets go onto the sheet upright only.
    """
    by_id = {part.id: part for part in parts}
    open_to_fold = [joint for joint in joints if joint.may_fold and joint.id not in barred]
    folding = [joint for joint in open_to_fold if _as_fold(joint, by_id)]
    nets: list[Net] = []
    for group in _groups(tuple(by_id), folding):
        own = tuple(joint for joint in folding if joint.parts[0] in group)
        nets += _best(tuple(by_id[name] for name in group), own, room, allowance, grain)
    order = {name: k for k, name in enumerate(by_id)}
    return tuple(sorted(nets, key=lambda net: order[next(iter(net.motions))]))


def _as_fold(joint: Joint, parts: Mapping[str, Part]) -> Fold | None:
    """None unless the paper continues across the joint with the same side printed."""
    first, second = (contacts(joint, parts[name]) for name in joint.parts)
    for one, other in zip(first, second, strict=True):
        if not (one.is_edge and other.is_edge and one.left != other.left):
            return None
    line = np.array([joint.stretches[0][0], joint.stretches[-1][1]])
    a, b = (parts[name].flat(line) for name in joint.parts)
    return Fold(joint, (a, b))


def _groups(names: Iterable[str], folding: Iterable[Joint]) -> list[list[str]]:
    """Parts that joints connect, in order."""
    import networkx

    graph = networkx.Graph()
    graph.add_nodes_from(names)
    graph.add_edges_from(joint.parts for joint in folding)
    order = {name: k for k, name in enumerate(graph)}
    return [sorted(group, key=order.__getitem__) for group in networkx.connected_components(graph)]


@lru_cache(maxsize=512)
def _best(
    parts: tuple[Part, ...], joints: tuple[Joint, ...], room: tuple[float, float], allowance: float, grain: bool
) -> tuple[Net, ...]:
    """The best nets of parts that joints connect, all of which can be creases.

    Plans of one design ask again and again for the same: it is remembered.
    """
    by_id = {part.id: part for part in parts}
    found = (_as_fold(joint, by_id) for joint in joints)
    own = sorted((fold for fold in found if fold), key=lambda fold: (-fold.joint.length, fold.joint.id))

    def goes_on(shape: "BaseGeometry") -> bool:
        return fits(shape.convex_hull, room, allowance, grain=grain)

    shuffled = Random(0)
    best: tuple[tuple[float, ...], list[Net]] | None = None
    for _ in range(TRIES):
        nets = _grow(parts, own, goes_on, grain)
        score = _score(nets, parts)
        if best is None or score < best[0]:
            best = score, nets
        if sum(len(net.folds) for net in nets) == len(own):
            break  # nothing is left open, no order does better
        own = shuffled.sample(own, len(own))
    return tuple(best[1]) if best else ()


def _score(nets: list[Net], parts: tuple[Part, ...]) -> tuple[float, ...]:
    """Less is better: folds left open, length of slits, length of open folds, area of the hulls."""
    from shapely import unary_union

    by_id = {part.id: part for part in parts}
    merged, creased, slit, hull = 0, 0.0, 0.0, 0.0
    for net in nets:
        shapes = [move_shape(motion, by_id[name].polygon) for name, motion in net.motions.items()]
        union = unary_union(shapes)
        own = sum(fold.length for fold in net.folds)
        merged += len(net.folds)
        creased += own
        slit += sum(shape.length for shape in shapes) / 2 - union.length / 2 - own
        hull += union.convex_hull.area
    return -merged, round(slit, 1), -round(creased, 1), round(hull, 0)


class _Cluster:
    """A growing net: motions of its parts and their outlines, shrunk by the overlap that is allowed."""

    def __init__(self, part: Part) -> None:
        self.motions: dict[str, FloatArray] = {part.id: np.eye(3)}
        self.shapes: list[BaseGeometry] = [part.polygon.buffer(-OVERLAP, join_style="mitre")]
        self.outlines: list[BaseGeometry] = [part.polygon]
        self.folds: list[Joint] = []

    @property
    def paper(self) -> float:
        """Area of its parts, mm^2."""
        return float(sum(outline.area for outline in self.outlines))


def _grow(parts: tuple[Part, ...], order: list[Fold], goes_on: GoesOn, grain: bool) -> list[Net]:
    """Kruskal: join clusters across folds in the given order wherever the result is a net.

    Where `grain` counts, the result lies as that of the two does which has more paper.
    """
    where = {part.id: _Cluster(part) for part in parts}
    for fold in order:
        first, second = (where[name] for name in fold.joint.parts)
        if first is second:
            if _coincides(fold, first):
                first.folds.append(fold.joint)
            continue
        if grain and second.paper > first.paper:
            first, second = second, first
        if _join(fold, first, second, goes_on):
            where |= dict.fromkeys(second.motions, first)
    clusters = list(dict.fromkeys(where[part.id] for part in parts))
    rank = {part.id: k for k, part in enumerate(parts)}
    return [
        Net(
            {name: cluster.motions[name] for name in sorted(cluster.motions, key=rank.__getitem__)},
            tuple(sorted(cluster.folds, key=lambda joint: joint.id)),
        )
        for cluster in clusters
    ]


def _coincides(fold: Fold, cluster: _Cluster) -> bool:
    a, b = (move(cluster.motions[name], ends) for name, ends in zip(fold.joint.parts, fold.ends, strict=True))
    return bool(np.abs(a - b).max() < COINCIDE)


def _join(fold: Fold, first: _Cluster, second: _Cluster, goes_on: GoesOn) -> bool:
    """Add `second` to `first`, which stays as it lies, unless they overlap or the result exceeds the sheet."""
    import shapely

    ends = dict(zip(fold.joint.parts, fold.ends, strict=True))
    target, source = (
        move(own.motions[name], ends[name]) for own in (first, second) for name in ends if name in own.motions
    )
    motion = segment_motion(source, target)
    shapes = [move_shape(motion, shape) for shape in second.shapes]
    if shapely.intersects(np.array(first.shapes)[:, None], np.array(shapes)[None]).any():
        return False
    outlines = first.outlines + [move_shape(motion, shape) for shape in second.outlines]
    if not goes_on(shapely.GeometryCollection(outlines)):
        return False
    first.shapes += shapes
    first.outlines = outlines
    first.motions |= {name: motion @ own for name, own in second.motions.items()}
    first.folds += [*second.folds, fold.joint]
    return True

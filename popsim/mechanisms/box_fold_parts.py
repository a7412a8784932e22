"""Finding the parts of a box-fold among the patches of a design, and measuring how true they are."""

from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np

from popsim.design import Hinge
from popsim.mechanisms.base import Recognition
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top
from popsim.mechanisms.condition import Condition, identity
from popsim.mechanisms.members import Members, along_x

LEAST_PAIR = 1.0
"""mm of hinge that front and back pairs need together: below this nothing keeps the box from shearing."""

ROUNDING = 1e-6
"""mm; ends that are meant to meet, after decimals."""

Box = TypeVar("Box", bound=BoxFold)


@dataclass(frozen=True)
class FoundTop:
    """A top half on each side, and their hinges to the sides and to each other or to the backbone."""

    patches: tuple[str, str]
    edges: tuple[Hinge, Hinge]
    ridges: tuple[Hinge, Hinge]
    on_backbone: bool

    def as_top(self, v: float) -> Top:
        """As a top of a mechanism: as far as any of its hinges, as a slit in it leaves two ridges of one."""
        xs = np.concatenate([hinge.points[:, 0] for hinge in (*self.edges, *self.ridges)])
        return Top(float(xs.min()), float(xs.max()), float(self.ridges[0].points[0, 2] - v))


@dataclass(frozen=True)
class FoundPair:
    """A front or back pair and its hinges: to L, to R, and between its two patches."""

    patches: tuple[str, str]
    edges: tuple[Hinge, Hinge]
    fold: Hinge
    facing: Literal[1, -1]

    def as_end_pair(self, v: float) -> EndPair:
        """As an end pair of a mechanism."""
        z = self.fold.points[:, 2] - v
        return EndPair(float(self.fold.points[0, 0]), float(z.min()), float(z.max()), self.facing)


def recognise_box(kind: type[Box], members: Members) -> Recognition:
    """Derive a box-fold; see :meth:`popsim.mechanisms.Mechanism.recognise`."""
    frame = _find_frame(members)
    if isinstance(frame, str):
        return Recognition.unlike(members.id, frame)
    left, right, backbone, feet = frame
    tops = _find_tops(members, left, right, backbone)
    if isinstance(tops, str):
        return Recognition.unlike(members.id, tops)
    ends = _find_pairs(members, left, right, {name for top in tops for name in top.patches})
    patches = [top.patches for top in tops] + [end.patches for end in ends]
    placed = {left, right, backbone, *(name for names in patches for name in names)}
    extra = sorted(set(members.record.patches) - placed)
    if extra:
        return Recognition.unlike(members.id, f"no place in a box-fold for {', '.join(extra)}")
    half = float(members.section(feet[0])[0])
    conditions = [*_side_conditions(members, tops, feet), *_pair_conditions(members, ends, feet)]
    v = members.pair.v
    profile = tuple(top.as_top(v) for top in tops)
    if not half > 0:
        return Recognition(None, tuple(conditions))
    pairs = tuple(end.as_end_pair(v) for end in ends)
    box = kind(members.id, members.pair, half, _adjoining(profile, pairs), pairs)
    conditions += _sweep_conditions(box)
    roles = {left: "L", right: "R", backbone: "C"}
    for names, own in zip(patches, [*box.top_roles(), *box.end_roles()], strict=True):
        roles |= dict(zip(names, own, strict=True))
    return Recognition(box, tuple(conditions), roles)


def _find_frame(members: Members) -> tuple[str, str, str, tuple[Hinge, Hinge]] | str:
    """L, R, backbone and the base hinges of L and R, or what is missing."""
    found: list[list[tuple[str, Hinge]]] = [[], []]
    spine = set()
    for index in (0, 1):
        for name, hinge in members.on_base(index):
            if abs(hinge.points[:, 1]).max() < 0.05:
                spine.add(name)
            else:
                found[index].append((name, hinge))
    if [len(side) for side in found] != [1, 1]:
        return "one side hinged to each base patch"
    if len(spine) != 1:
        return "one backbone on the fold line"
    (left, foot_l), (right, foot_r) = found[0][0], found[1][0]
    return left, right, spine.pop(), (foot_l, foot_r)


def _find_tops(members: Members, left: str, right: str, backbone: str) -> list[FoundTop] | str:
    """The tops from back to front, or what is missing."""
    halves = [[(n, h) for n, h in members.neighbours(side) if along_x(h)] for side in (left, right)]
    tops = []
    for name, edge in halves[0]:
        for other, other_edge in halves[1]:
            ridge, on_backbone = members.between(name, other), members.between(name, backbone)
            other_on = members.between(other, backbone)
            first, second = ridge or on_backbone, ridge or other_on
            if first is None or second is None or not _overlap(first, second):
                continue
            glued = on_backbone is not None or other_on is not None
            tops.append(FoundTop((name, other), (edge, other_edge), (first, second), glued))
    if not tops or len(tops) != len(halves[0]) or len(tops) != len(halves[1]):
        return "tops on both sides that meet over the backbone"
    return sorted(tops, key=lambda top: float(top.ridges[0].points[:, 0].mean()))


def _find_pairs(members: Members, left: str, right: str, tops: set[str]) -> list[FoundPair]:
    """The end pairs along x; patches at L and R that share a fold."""
    pairs = []
    for name, edge in members.neighbours(left):
        for other, other_edge in members.neighbours(right):
            fold = members.between(name, other)
            if fold is None or tops & {name, other}:
                continue
            toward = 0.0 if fold.crease is None else fold.crease[0]
            facing: Literal[1, -1] = 1 if toward > 0 else -1
            pairs.append(FoundPair((name, other), (edge, other_edge), fold, facing))
    return sorted(pairs, key=lambda pair: float(pair.fold.points[0, 0]))


def _side_conditions(members: Members, tops: list[FoundTop], feet: tuple[Hinge, Hinge]) -> list[Condition]:
    """G + l = c + t_g and b + r = c + t_b for each top, and what makes them exact (Sec. 3.3.1)."""
    subject = members.id
    base = [float(members.section(foot)[0]) for foot in feet]
    conditions = [identity("foldable", subject, "g = b (sides equidistant from the fold)", base[0] - base[1])]
    names = (("g", "l", "t_g"), ("b", "r", "t_b"))
    for top in tops:
        for index, (page, side, width) in enumerate(names):
            ridge, edge = members.section(top.ridges[index]), members.section(top.edges[index])
            spine, across = float(np.linalg.norm(ridge)), float(np.linalg.norm(edge - ridge))
            up = float(np.linalg.norm(edge - [base[index], 0.0]))
            name = f"{page} + {side} = c + {width} at {top.patches[index]}"
            conditions.append(identity("foldable", subject, name, base[index] + up - spine - across))
            name = f"{page} = {width} at {top.patches[index]} (sides parallel to the backbone)"
            conditions.append(identity("foldable", subject, name, base[index] - across))
            name = f"ridge of {top.patches[index]} over the fold line"
            conditions.append(identity("foldable", subject, name, float(ridge[0])))
        glued = 1.0 if top.on_backbone else -1.0
        conditions.append(Condition("stable", subject, f"{top.patches[0]} glued to the backbone", glued))
    return conditions


def _pair_conditions(members: Members, ends: list[FoundPair], feet: tuple[Hinge, Hinge]) -> list[Condition]:
    """Pairs keep the box from shearing, and their folds are coplanar with the backbone (Sec. 3.3.1)."""
    subject = members.id
    hinged = sum(min(end.edges[0].length, end.edges[1].length, end.fold.length) for end in ends)
    name = "front and back pairs keep it from shearing (mm of hinge beyond the least)"
    conditions = [Condition("stable", subject, name, hinged - LEAST_PAIR)]
    walls = [float(foot.points[0, 1]) for foot in feet]
    for end in ends:
        label = " and ".join(end.patches)
        x = float(end.fold.points[0, 0])
        off, lean = float(np.abs(end.fold.points[:, 1]).max()), float(np.ptp(end.fold.points[:, 0]))
        conditions.append(identity("foldable", subject, f"fold of {label} in the plane of C", off))
        conditions.append(identity("foldable", subject, f"fold of {label} upright", lean))
        for edge, wall in zip(end.edges, walls, strict=True):
            away = max(float(np.abs(edge.points[:, 0] - x).max()), float(np.abs(edge.points[:, 1] - wall).max()))
            conditions.append(identity("foldable", subject, f"{label} square to the sides", away))
    return conditions


def _sweep_conditions(box: BoxFold) -> list[Condition]:
    """No pair sweeps through a top, the backbone or an opposite pair of its own box (`clear`)."""
    conditions = []
    for end in box.end_pairs:
        low, high = sorted((end.x, end.x + end.facing * box.half_width))
        inside = [top.height for top in box.tops if top.x0 < high - 1e-6 and top.x1 > low + 1e-6]
        if inside:
            name = f"pair at x = {end.x:g} facing {end.facing:+d} sweeps above the tops before it"
            conditions.append(Condition("clear", box.id, name, end.low - max(inside) + 1e-6))
        for other in box.end_pairs:
            if end.facing == 1 and other.facing == -1 and other.x > end.x:
                gap = (other.x - box.half_width) - (end.x + box.half_width)
                apart = max(end.low - other.high, other.low - end.high)
                name = f"pairs at x = {end.x:g} and {other.x:g} sweep clear of each other"
                conditions.append(Condition("clear", box.id, name, max(gap, apart) + 1e-6))
    return conditions


def _overlap(first: Hinge, second: Hinge) -> bool:
    """Whether two hinges along x share some of their extent."""
    a, b = np.sort(first.points[:, 0]), np.sort(second.points[:, 0])
    return bool(min(a[1], b[1]) - max(a[0], b[0]) > ROUNDING)


def _adjoining(tops: tuple[Top, ...], pairs: tuple[EndPair, ...]) -> tuple[Top, ...]:
    """Tops whose ends coincide exactly: where contours leave a gap, at the end pair in it, else in its middle."""
    joined = [tops[0]]
    for top in tops[1:]:
        low, high = sorted((joined[-1].x1, top.x0))
        steps = [pair.x for pair in pairs if low - ROUNDING <= pair.x <= high + ROUNDING]
        border = steps[0] if steps else (low + high) / 2
        joined[-1] = joined[-1]._replace(x1=border)
        joined.append(top._replace(x0=border))
    return tuple(joined)

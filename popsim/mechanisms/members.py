"""What a design says of one mechanism through patches and hinges alone, in the terms that recognition needs."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.design import Design, Hinge, MechanismRecord, Patch
from popsim.errors import DesignError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import Side
from popsim.geometry.plane import line_distance
from popsim.mechanisms.pair import BasePatchPair, PairKind

ON_LINE = 0.05
"""mm; a hinge end nearer than this to a line lies on it. Wide: what is measured afterwards says how well."""

STRAIGHT = 1 - 1e-6
"""|cos| above which two directions are one (0.08 degrees)."""


@dataclass(frozen=True, eq=False)
class Members:
    """The patches and hinges of a mechanism in a design.

    Positions in a cross-section are (u, v): distance from the bisecting plane and height, both measured from the
    pair's fold line.
    """

    design: Design
    record: MechanismRecord

    @property
    def id(self) -> str:
        """Id of the mechanism."""
        return self.record.id

    @cached_property
    def pair(self) -> BasePatchPair:
        """The base patch pair, from the hinge that its two patches share.

        Raises
        ------
        DesignError
            The base patches share no fold line, or not one along x that fits either kind of pair.
        """
        return pair_of(self.design, self.record)

    @cached_property
    def hinges(self) -> tuple[Hinge, ...]:
        """Hinges at its own patches; several on one line, with gaps between them, stand as one."""
        own = set(self.record.patches)
        lines: dict[frozenset[str], list[Hinge]] = {}
        for hinge in self.design.hinges:
            if own.intersection(hinge.patches):
                lines.setdefault(frozenset(hinge.patches), []).append(hinge)
        return tuple(_as_one(hinges) for hinges in lines.values())

    @cached_property
    def inner(self) -> tuple[Hinge, ...]:
        """Hinges between two of its own patches."""
        own = set(self.record.patches)
        return tuple(hinge for hinge in self.hinges if own.issuperset(hinge.patches))

    def patch(self, name: str) -> Patch:
        """A patch of the design."""
        return self.design.patch_by_id[name]

    def on_base(self, index: int) -> list[tuple[str, Hinge]]:
        """Own patches hinged to patch `index` of the pair, with the hinge."""
        base, own = self.pair.patches[index], set(self.record.patches)
        return [(h.other(base), h) for h in self.hinges if base in h.patches and h.other(base) in own]

    def neighbours(self, name: str) -> Iterator[tuple[str, Hinge]]:
        """Own patches hinged to own patch `name`, with the hinge."""
        for hinge in self.inner:
            if name in hinge.patches:
                yield hinge.other(name), hinge

    def between(self, first: str, second: str) -> Hinge | None:
        """The hinge between two patches, one of them its own, or None."""
        return next((h for h in self.hinges if set(h.patches) == {first, second}), None)

    def extent_x(self) -> tuple[float, float]:
        """Least and greatest x of its patches in the open pose."""
        xs = np.concatenate([self.patch(name).points[:, 0] for name in self.record.patches])
        return float(xs.min()), float(xs.max())

    def section(self, hinge: Hinge) -> FloatArray:
        """(u, v) of the middle of a hinge, shape (2,)."""
        _, y, z = hinge.points.mean(axis=0)
        return np.array([abs(y) - self.pair.u, z - self.pair.v])


def _as_one(hinges: list[Hinge]) -> Hinge:
    """One hinge from end to end of several on one line."""
    if len(hinges) == 1:
        return hinges[0]
    ends = [end for hinge in hinges for end in hinge.axis]
    along = np.array(ends) @ (hinges[0].points[1] - hinges[0].points[0])
    return hinges[0].model_copy(update={"axis": (ends[int(along.argmin())], ends[int(along.argmax())])})


def along_x(hinge: Hinge) -> bool:
    """Whether a hinge runs parallel to the central fold."""
    return bool(np.abs(hinge.points[1, 1:] - hinge.points[0, 1:]).max() < ON_LINE)


def along_z(hinge: Hinge) -> bool:
    """Whether a hinge is upright."""
    return bool(np.abs(hinge.points[1, :2] - hinge.points[0, :2]).max() < ON_LINE)


def pair_of(design: Design, record: MechanismRecord) -> BasePatchPair:
    """The base patch pair of a mechanism in a design; see :attr:`Members.pair`."""
    line = _fold_line(design, record.base)
    named = f"mechanism {record.id}: base {{{', '.join(record.base)}}}"
    if line is None:
        raise DesignError(f"{named} shares no fold line; a mechanism stands on two patches that share a fold")
    if np.abs(line[1, 1:] - line[0, 1:]).max() > ON_LINE:
        raise DesignError(f"{named} has a fold that is not parallel to the central fold")
    patches = [design.patch_by_id[name] for name in record.base]
    x = (max(float(p.points[:, 0].min()) for p in patches), min(float(p.points[:, 0].max()) for p in patches))
    if not x[0] < x[1]:
        raise DesignError(f"{named}: its two patches do not overlap along x")
    y, z = (float(value) for value in line[:, 1:].mean(axis=0))
    floors = [patch for patch in patches if abs(patch.plane.normal[2]) > STRAIGHT]
    walls = [patch for patch in patches if abs(patch.plane.normal[1]) > STRAIGHT]
    owner = _owner(design, record.base)
    if len(floors) == 2 and abs(y) <= ON_LINE:
        ground, backdrop = sorted(floors, key=lambda patch: -patch.points[:, 1].mean())
        reach = (float(np.abs(ground.points[:, 1]).max()), float(np.abs(backdrop.points[:, 1]).max()))
        return BasePatchPair(
            (ground.id, backdrop.id), PairKind.OPENING, Side.GROUND, 0.0, z, x, reach, owner=owner
        )
    if len(floors) == len(walls) == 1:
        floor, wall = floors[0], walls[0]
        side = Side.GROUND if floor.points[:, 1].mean() > 0 else Side.BACKDROP
        reach = (float(np.abs(floor.points[:, 1] - y).max()), float(wall.points[:, 2].max() - z))
        return BasePatchPair((floor.id, wall.id), PairKind.CORNER, side, abs(y), z, x, reach, owner=owner)
    raise DesignError(
        f"{named} is neither two levels that meet at y = 0 (an opening pair) nor floor and upright wall (a corner)"
    )


def _fold_line(design: Design, base: tuple[str, str]) -> FloatArray | None:
    """Axis (2, 3) that both patches turn about: their common hinge, or two hinges on one line with a third."""
    first, second = base
    shared = None
    for hinge in design.hinges_by_patch[first]:
        if hinge.other(first) == second:
            return hinge.points
        for further in design.hinges_by_patch[hinge.other(first)]:
            if further.other(hinge.other(first)) == second and (
                line_distance(further.points, hinge.points).max() < ON_LINE
            ):
                shared = hinge.points
    return shared


def _owner(design: Design, base: tuple[str, str]) -> str | None:
    """The mechanism that offers a pair: the owner of both, or the one that stands on the other's."""
    owners = [design.owner[name] for name in base if name in design.owner]
    if not owners:
        return None
    first, last = owners[0], owners[-1]
    return first if last in _ancestors(design, first) else last


def _ancestors(design: Design, name: str) -> set[str]:
    found: set[str] = set()
    frontier = [name]
    while frontier:
        for base in design.mechanism_by_id[frontier.pop()].base:
            owner = design.owner.get(base)
            if owner is not None and owner not in found:
                found.add(owner)
                frontier.append(owner)
    return found

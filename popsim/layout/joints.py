"""Joints: where two parts meet. Each hinge of the design is one, or one per pair of parts that it runs over."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from popsim.design import Design, Hinge
from popsim.design.rules import TOUCHING
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common
from popsim.layout.parts import Part

SHORTEST = 0.5
"""mm; stretches below this hold nothing and are left out, unless the hinge has no other."""

LEAST_SHARE = 5.0
"""mm; where a hinge runs over several parts, shorter ends of it on one of them are left unglued."""


@dataclass(frozen=True, eq=False)
class Joint:
    """A line along which two parts are held together.

    Attributes
    ----------
    id:
        The hinge's id, with "/k" where the hinge runs over several pairs of parts; "seam ..." within one patch.
    hinge:
        The hinge it is (part) of; None for a seam, which never turns.
    parts:
        Ids of the two parts.
    stretches:
        The stretches of the line where there is paper of both, ends in the open pose, each of shape (2, 3).
    """

    id: str
    hinge: Hinge | None
    parts: tuple[str, str]
    stretches: tuple[FloatArray, ...]

    @property
    def length(self) -> float:
        """Length of all stretches, mm."""
        return sum(float(np.linalg.norm(ends[1] - ends[0])) for ends in self.stretches)

    @property
    def may_fold(self) -> bool:
        """Whether the design lets the two parts be one piece of paper."""
        return self.hinge is not None and self.hinge.kind != "glue"

    def other(self, part: str) -> str:
        """The part at the other side."""
        return self.parts[1] if part == self.parts[0] else self.parts[0]


def find_joints(design: Design, parts: tuple[Part, ...]) -> tuple[Joint, ...]:
    """All joints between `parts`: the hinges in the order of the design, then the seams."""
    by_patch: dict[str, list[Part]] = {}
    for part in parts:
        by_patch.setdefault(part.patch.id, []).append(part)
    joints: list[Joint] = []
    for hinge in design.hinges:
        joints += _of_hinge(hinge, by_patch)
    for pieces in by_patch.values():
        joints += _seams(pieces)
    return tuple(joints)


def _of_hinge(hinge: Hinge, by_patch: dict[str, list[Part]]) -> list[Joint]:
    pairs = [(a, b) for a in by_patch[hinge.patches[0]] for b in by_patch[hinge.patches[1]]]
    along = {part.id: _covered(part, hinge.points) for pair in pairs for part in pair}
    found: list[Joint] = []
    for first, second in pairs:
        common = list(_common(along[first.id], along[second.id]))
        if not common and len(pairs) == 1:  # paper meets beside the hinge only by a hair: trust the design
            common = [(0.0, hinge.length)]
        if common:
            found.append(Joint(hinge.id, hinge, (first.id, second.id), _stretches(hinge.points, common)))
    longest = max(joint.length for joint in found)
    held = [joint for joint in found if joint.length >= min(LEAST_SHARE, longest)]
    if len(held) == 1:
        return held
    return [replace(joint, id=f"{hinge.id}/{k}") for k, joint in enumerate(held, 1)]


def _covered(part: Part, axis: FloatArray) -> list[tuple[float, float]]:
    """Where along `axis` (2, 3) the part has paper, mm from its start."""
    import shapely
    from shapely.geometry import LineString

    ends = part.flat(axis)
    length = float(np.linalg.norm(ends[1] - ends[0]))
    direction = (ends[1] - ends[0]) / length
    spans = []
    for piece in shapely.get_parts(part.polygon.buffer(TOUCHING).intersection(LineString(ends))):
        if piece.is_empty:
            continue
        along = (shapely.get_coordinates(piece) - ends[0]) @ direction
        low, high = float(along.min()), float(along.max())
        start = low if low < TOUCHING else low + TOUCHING
        spans.append((start, high if high > length - TOUCHING else high - TOUCHING))
    return sorted(spans)


def _common(first: list[tuple[float, float]], second: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    for low, high in first:
        for other_low, other_high in second:
            start, end = max(low, other_low), min(high, other_high)
            if end - start >= SHORTEST:
                yield start, end


def _stretches(axis: FloatArray, spans: list[tuple[float, float]]) -> tuple[FloatArray, ...]:
    direction = (axis[1] - axis[0]) / np.linalg.norm(axis[1] - axis[0])
    return tuple(np.array([axis[0] + low * direction, axis[0] + high * direction]) for low, high in spans)


def _seams(pieces: list[Part]) -> Iterator[Joint]:
    """Joints between the parts of one patch, which share straight stretches of their outlines."""
    import shapely

    for first, second in combinations(pieces, 2):
        shared = shapely.line_merge(common(first.polygon, second.polygon))
        lines = [line for line in shapely.get_parts(shared) if line.length >= SHORTEST]
        if lines:
            ends = [shapely.get_coordinates(line)[[0, -1]] for line in lines]
            stretches = tuple(first.plane.lift(pair) for pair in ends)
            yield Joint(f"seam {first.id}-{second.id}", None, (first.id, second.id), stretches)

"""Joints: where two parts meet.

All hinges between two patches lie on one line and make one joint, or one per pair of parts that they run over.
"""

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
        The first hinge's id, with "/k" where they run over several pairs of parts; "seam ..." within one patch.
    hinges:
        The hinges that it is (part) of: contours cut a line into several. None for a seam, which never turns.
    parts:
        Ids of the two parts.
    stretches:
        The stretches of the line where there is paper of both, ends in the open pose, each of shape (2, 3).
    """

    id: str
    hinges: tuple[Hinge, ...]
    parts: tuple[str, str]
    stretches: tuple[FloatArray, ...]

    @property
    def hinge(self) -> Hinge | None:
        """The first hinge, which says for all how the joint turns; None for a seam."""
        return self.hinges[0] if self.hinges else None

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
    together: dict[tuple[object, ...], list[Hinge]] = {}
    for hinge in design.hinges:
        together.setdefault((frozenset(hinge.patches), hinge.kind, hinge.crease), []).append(hinge)
    joints: list[Joint] = []
    for hinges in together.values():
        joints += _of_hinges(tuple(hinges), by_patch)
    for pieces in by_patch.values():
        joints += _seams(pieces)
    return tuple(joints)


def _of_hinges(hinges: tuple[Hinge, ...], by_patch: dict[str, list[Part]]) -> list[Joint]:
    """Joints along one line, by the pairs of parts that have paper there."""
    name, patches = hinges[0].id, hinges[0].patches
    axis, spans = _line(hinges)
    pairs = [(a, b) for a in by_patch[patches[0]] for b in by_patch[patches[1]]]
    along = {part.id: list(_common(spans, _covered(part, axis))) for pair in pairs for part in pair}
    found: list[Joint] = []
    for first, second in pairs:
        common = list(_common(along[first.id], along[second.id]))
        if not common and len(pairs) == 1:  # paper meets beside the hinge only by a hair: trust the design
            common = spans
        if common:
            found.append(Joint(name, hinges, (first.id, second.id), _stretches(axis, common)))
    longest = max(joint.length for joint in found)
    held = [joint for joint in found if joint.length >= min(LEAST_SHARE, longest)]
    if len(held) == 1:
        return held
    return [replace(joint, id=f"{name}/{k}") for k, joint in enumerate(held, 1)]


def _line(hinges: tuple[Hinge, ...]) -> tuple[FloatArray, list[tuple[float, float]]]:
    """The line (2, 3) from the first to the last end of some hinges, and where on it each of them runs, mm."""
    start = hinges[0].points[0]
    direction = (hinges[0].points[1] - start) / hinges[0].length
    ends = np.sort(np.array([(hinge.points - start) @ direction for hinge in hinges]), axis=1)
    low, high = float(ends.min()), float(ends.max())
    axis = start + np.array([[low], [high]]) * direction
    return axis, sorted((float(a) - low, float(b) - low) for a, b in ends)


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
            yield Joint(f"seam {first.id}-{second.id}", (), (first.id, second.id), stretches)

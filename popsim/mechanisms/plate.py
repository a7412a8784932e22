"""Plates and joints: the patches and hinges of a mechanism in the open pose."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import pairwise
from math import isnan, sqrt
from typing import Any, Literal, NamedTuple, Self, TypeVar

import numpy as np

from popsim.geometry.arrays import FloatArray, locked

T = TypeVar("T")

Point = tuple[float, float, float]
"""A corner, card frame, mm."""

Kind = Literal["fold", "glue"]
"""Of a hinge: "fold" where both patches can be one piece of paper, "glue" where a flap joins them."""

FIRST_BASE = "base:0"
"""Stands for the first patch of the base patch pair in a joint."""

SECOND_BASE = "base:1"
"""Stands for the second patch of the base patch pair in a joint."""

BESIDE = 0.35
"""Beyond its face a plate shows the model, unless it says otherwise, to this share of the depth `behind`,"""

BESIDE_OF_FACE = 0.3
"""and to at most this share of the side of a square as large as the face."""

NO_HINGES = locked(np.zeros((0, 2, 3)), (None, 2, 3), "hinges")

NOTHING_TAKEN = locked(np.zeros((0, 3)), (None, 3), "taken")

SHAPES: dict[str, tuple[int | None, ...]] = {
    "outline": (None, 3),
    "room": (None, 3),
    "outward": (3,),
    "hinges": (None, 2, 3),
    "taken": (None, 3),
}
"""Of the arrays of a plate."""

LEVEL = 0.5
"""Plates whose normal rises by as much lie rather than stand upright."""


@dataclass(frozen=True, eq=False)
class Plate:
    """A patch of a mechanism before the contours of a model are cut into it.

    Attributes
    ----------
    role:
        The paper's name of the patch (L, T_G, F_R ...), unique in its mechanism.
    outline:
        The face it represents, open pose, shape (n, 3).
    outward:
        Unit normal to the side that is seen, shape (3,); patches inside have either.
    principal:
        Whether it shows a principal face of the primitive (Fig. 3); only those count in Eq. 2. A plate inside
        shows the model only beyond its face, where it is seen from both sides: a fin.
    room:
        How far its outline may follow the contours of the model without getting into the way of its own
        mechanism, a polygon in the plane of the face, shape (k, 3); by default the face itself.
    behind:
        How deep behind the face, mm, the model still shows on it.
    beside:
        The same in its room beyond the face.
    hinges:
        Ends of the lines at which it is hinged, shape (k, 2, 3); none until it is looked at with its mechanism.
    taken:
        What others take of the room of a plate along the fold: from one x to another all from some height on, mm,
        shape (k, 3); nothing until it is looked at with other mechanisms.
    """

    role: str
    outline: FloatArray
    outward: FloatArray
    principal: bool = True
    room: FloatArray | None = None
    behind: float = np.inf
    beside: float = np.nan
    hinges: FloatArray = field(default_factory=lambda: NO_HINGES)
    taken: FloatArray = field(default_factory=lambda: NOTHING_TAKEN)

    def __post_init__(self) -> None:
        if self.room is None:
            object.__setattr__(self, "room", self.outline)
        for name, shape in SHAPES.items():
            object.__setattr__(self, name, locked(getattr(self, name), shape, f"{name} of {self.role}"))
        if isnan(self.beside):
            object.__setattr__(self, "beside", _depth_beside(self.behind, self.area))

    def but(self, **changed: FloatArray | float) -> Self:
        """The plate with other values of some fields; nothing else is checked or worked out anew.

        Raises
        ------
        GeometryError
            An array is not of its shape, or not finite.
        """
        whole = {
            name: locked(value, SHAPES[name], f"{name} of {self.role}") if name in SHAPES else value
            for name, value in changed.items()
        }
        known = self.__dict__ | whole
        for name in ("area", "left") if "outline" in changed else ("left",):
            known.pop(name, None)
        return _made(type(self), known)

    @cached_property
    def area(self) -> float:
        """Area of the face, mm^2."""
        return _area(self.outline.tolist())

    @cached_property
    def left(self) -> FloatArray:
        """What others leave of its room, where that hangs together with its face, shape (n, 3)."""
        assert self.room is not None  # plates give themselves room
        if not len(self.taken):
            return self.room
        face, room = (tuple(map(tuple, ring[:, ::2].tolist())) for ring in (self.outline, self.room))
        ring = _beneath(face, room, tuple(map(tuple, self.taken.tolist())))
        return np.column_stack([ring[:, 0], np.full(len(ring), self.outline[0, 1]), ring[:, 1]])

    @property
    def lies(self) -> bool:
        """Whether it lies rather than stands upright in the open pose."""
        return bool(abs(self.outward[2]) >= LEVEL)


@dataclass(frozen=True, eq=False)
class Joint:
    """A hinge between two plates, or between a plate and a patch of the base pair.

    Attributes
    ----------
    roles:
        Two roles, or FIRST_BASE / SECOND_BASE.
    axis:
        Ends of the hinge line, open pose, shape (2, 3).
    kind:
        "fold" where both can be one piece of paper, "glue" where a flap joins them.
    crease:
        To which side a crease that is flat in the open pose bulges, shape (3,), or None.
    """

    roles: tuple[str, str]
    axis: FloatArray
    kind: Kind
    crease: FloatArray | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "axis", locked(self.axis, (2, 3), "axis"))
        if self.crease is not None:
            object.__setattr__(self, "crease", locked(self.crease, (3,), "crease"))


class Face(NamedTuple):
    """What a plate is made of: its fields, with corners one by one; `outward` is read-only.

    Of what is the same on both sides of the fold corners come in the same order: then it is looked at once only.
    """

    role: str
    outline: Sequence[Point]
    outward: FloatArray
    principal: bool = True
    room: Sequence[Point] | None = None
    behind: float = np.inf
    beside: float = np.nan


class Line(NamedTuple):
    """What a joint is made of: its fields, with the ends of its axis one by one; a `crease` is read-only."""

    roles: tuple[str, str]
    start: Point
    end: Point
    kind: Kind
    crease: FloatArray | None = None


def rectangle(x: tuple[float, float], start: tuple[float, float], end: tuple[float, float]) -> list[Point]:
    """Corners of a rectangle over x between two points (y, z) of one cross-section."""
    return [(x[0], *start), (x[1], *start), (x[1], *end), (x[0], *end)]


def plates_from(faces: Sequence[Face]) -> tuple[Plate, ...]:
    """The plates of faces, many at once in a fraction of the time; their corners share one array.

    Raises
    ------
    GeometryError
        A corner is not finite.
    """
    rings = [ring for face in faces for ring in (face.outline, face.room or face.outline)]
    corners = locked([corner for ring in rings for corner in ring], (None, 3), "corners of plates")
    plates, start = [], 0
    for face, outline, room in zip(faces, rings[::2], rings[1::2], strict=True):
        middle, end = start + len(outline), start + len(outline) + len(room)
        area = _area(outline)
        own = face._asdict() | {"outline": corners[start:middle], "room": corners[middle:end], "area": area}
        if isnan(face.beside):
            own["beside"] = _depth_beside(face.behind, area)
        plates.append(_made(Plate, own | {"hinges": NO_HINGES, "taken": NOTHING_TAKEN}))
        start = end
    return tuple(plates)


def joints_from(lines: Sequence[Line]) -> tuple[Joint, ...]:
    """The joints of lines, likewise.

    Raises
    ------
    GeometryError
        An end is not finite.
    """
    axes = locked([(line.start, line.end) for line in lines], (None, 2, 3), "ends of hinges")
    return tuple(
        _made(Joint, {"roles": line.roles, "axis": axis, "kind": line.kind, "crease": line.crease})
        for line, axis in zip(lines, axes, strict=True)
    )


def hinged(plates: Sequence[Plate], joints: Sequence[Joint]) -> tuple[Plate, ...]:
    """Plates with their hinges among some joints: each line once, in one order on both sides of the fold."""
    lines: dict[str, set[tuple[Point, ...]]] = {plate.role: set() for plate in plates}
    for joint in joints:
        first, second = map(tuple, joint.axis.tolist())
        line = (first, second) if _along(first) <= _along(second) else (second, first)
        for role in joint.roles:
            if role in lines:
                lines[role].add(line)
    found = []
    for plate in plates:
        own = np.array(sorted(lines[plate.role], key=lambda line: tuple(map(_along, line)))).reshape(-1, 2, 3)
        own.setflags(write=False)
        found.append(_made(type(plate), plate.__dict__ | {"hinges": own}))
    return tuple(found)


def _along(point: Point) -> Point:
    """A point, or its mirror image, by which ends and lines are put in order."""
    return point[0], abs(point[1]), point[2]


def _made(kind: type[T], values: dict[str, Any]) -> T:
    """Something whose fields are known to be right."""
    found = object.__new__(kind)
    found.__dict__.update(values)
    return found


def _depth_beside(behind: float, area: float) -> float:
    """How deep the model shows beyond a face, where nobody says, mm."""
    return min(BESIDE * behind, BESIDE_OF_FACE * sqrt(area))


def _area(ring: Sequence[Sequence[float]]) -> float:
    """Area of a flat ring of corners, mm^2."""
    (x, y, z), *rest = ring
    around = [(a - x, b - y, c - z) for a, b, c in rest]
    first = second = third = 0.0
    for (a, b, c), (d, e, f) in pairwise(around):
        first, second, third = first + b * f - c * e, second + c * d - a * f, third + a * e - b * d
    return sqrt(first * first + second * second + third * third) / 2


@lru_cache(maxsize=256)
def _beneath(
    face: tuple[tuple[float, float], ...],
    room: tuple[tuple[float, float], ...],
    taken: tuple[tuple[float, float, float], ...],
) -> FloatArray:
    """Corners (x, z), (n, 2), of what is left of a room around a face: plates of both sides have the same."""
    import shapely

    whole, around = shapely.polygons(shapely.linearrings(face)), shapely.polygons(shapely.linearrings(room))
    x0, x1, z = np.array(taken).T
    blocks = shapely.box(x0, z, x1, max(z for _, z in room) + 1.0)
    free = shapely.difference(around, blocks[0] if len(blocks) == 1 else shapely.union_all(blocks))
    parts = shapely.get_parts(shapely.union(whole, free))
    if len(parts) > 1:
        parts = parts[shapely.intersects(parts, whole)]
    largest = parts[shapely.area(parts).argmax()]
    corners: FloatArray = shapely.get_coordinates(shapely.get_exterior_ring(largest))[:-1]
    return corners

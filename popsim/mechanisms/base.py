"""What all mechanisms have in common."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field, fields
from functools import cached_property
from math import hypot, isnan, sqrt
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.frame import OPEN
from popsim.geometry.plane import area_vector
from popsim.geometry.rigid import Frame, motion_between, transform
from popsim.mechanisms.condition import Condition
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind
from popsim.mechanisms.primitive import Primitive
from popsim.mechanisms.room import Room

FIRST_BASE = "base:0"
"""Stands for the first patch of the base patch pair in a joint."""

SECOND_BASE = "base:1"
"""Stands for the second patch of the base patch pair in a joint."""

BESIDE = 0.35
"""Beyond its face a plate shows the model, unless it says otherwise, to this share of the depth `behind`,"""

BESIDE_OF_FACE = 0.3
"""and to at most this share of the side of a square as large as the face."""

NO_HINGES = locked(np.zeros((0, 2, 3)), (None, 2, 3), "hinges")

SHAPES: dict[str, tuple[int | None, ...]] = {
    "outline": (None, 3),
    "room": (None, 3),
    "outward": (3,),
    "hinges": (None, 2, 3),
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
    """

    role: str
    outline: FloatArray
    outward: FloatArray
    principal: bool = True
    room: FloatArray | None = None
    behind: float = np.inf
    beside: float = np.nan
    hinges: FloatArray = field(default_factory=lambda: NO_HINGES)

    def __post_init__(self) -> None:
        if self.room is None:
            object.__setattr__(self, "room", self.outline)
        for name, shape in SHAPES.items():
            object.__setattr__(self, name, locked(getattr(self, name), shape, f"{name} of {self.role}"))
        if isnan(self.beside):
            object.__setattr__(self, "beside", min(BESIDE * self.behind, BESIDE_OF_FACE * sqrt(self.area)))

    def but(self, **changed: FloatArray | float) -> Self:
        """The plate with other values of some fields; nothing else is checked or worked out anew.

        Raises
        ------
        GeometryError
            An array is not of its shape, or not finite.
        """
        other = copy(self)
        other.__dict__.pop("area", None)
        for name, value in changed.items():
            whole = locked(value, SHAPES[name], f"{name} of {self.role}") if name in SHAPES else value
            object.__setattr__(other, name, whole)
        return other

    @cached_property
    def area(self) -> float:
        """Area of the face, mm^2."""
        return hypot(*area_vector(self.outline).tolist()) / 2

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
    kind: Literal["fold", "glue"]
    crease: FloatArray | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "axis", locked(self.axis, (2, 3), "axis"))
        if self.crease is not None:
            object.__setattr__(self, "crease", locked(self.crease, (3,), "crease"))


@dataclass(frozen=True)
class Mechanism(ABC):
    """A mechanism on its base patch pair. Subclasses add their parameters as fields, in mm.

    The law of the family, which tests hold every member to: the ends of each joint coincide in the poses of its
    two plates at every fold angle, and in the closed pose all plates lie in the bisecting plane y = 0.
    """

    id: str
    pair: BasePatchPair

    type: ClassVar[str]
    """Name in design.json."""
    pair_kind: ClassVar[PairKind]
    """The kind of pair it can stand on (Sec. 3.3.2)."""

    def __post_init__(self) -> None:
        if self.pair.kind is not self.pair_kind:
            raise GeometryError(
                f"{self.id}: a {self.type} stands on {self.pair_kind.value} pairs, not on the "
                f"{self.pair.kind.value} pair {{{', '.join(self.pair.patches)}}}"
            )
        self._check_parameters()

    @abstractmethod
    def _check_parameters(self) -> None:
        """Raise GeometryError where the parameters are no mechanism at all."""

    @abstractmethod
    def plates(self) -> tuple[Plate, ...]:
        """All patches in the open pose."""

    @abstractmethod
    def joints(self) -> tuple[Joint, ...]:
        """All hinges in the open pose."""

    @abstractmethod
    def frames(self, theta: FloatArray) -> dict[str, Frame]:
        """A frame fixed to each plate at fold angles theta (n,), in closed form, by role."""

    @abstractmethod
    def pairs(self) -> tuple[BasePatchPair, ...]:
        """The base patch pairs it offers (Fig. 13)."""

    @abstractmethod
    def closing_range(self) -> tuple[float, float]:
        """Least and greatest x it reaches while closing, of its faces alone (Sec. 3.3.2)."""

    @abstractmethod
    def closed_extent(self) -> float:
        """How far from the central fold its faces reach when closed, mm."""

    @classmethod
    @abstractmethod
    def recognise(cls, members: Members) -> "Recognition":
        """Derive the mechanism and its conditions (Sec. 3.3.1) from the patches and hinges of a design."""

    @classmethod
    @abstractmethod
    def from_primitive(cls, primitive: Primitive, pair: BasePatchPair, id: str) -> Iterator["Mechanism"]:
        """All mechanisms of this type on `pair` that represent `primitive` (Table 1); none where it cannot."""

    @abstractmethod
    def primitive(self) -> Primitive:
        """The primitive that it represents: what :meth:`from_primitive` makes it of."""

    @classmethod
    @abstractmethod
    def random(cls, rng: Generator, pair: BasePatchPair, id: str, room: Room) -> Self | None:
        """Draw a valid mechanism on `pair` that stays within `room`, or None where there is too little.

        Campaigns of verification are made of these; they should cover all that the type can be. Moving pair and
        room along x moves the mechanism that the same numbers give.
        """

    @abstractmethod
    def faults(self) -> tuple[Fault, ...]:
        """Ways to spoil it so that it does not fold; campaigns check that verification sees them."""

    def poses(self, theta: FloatArray) -> dict[str, FloatArray]:
        """Rigid motion of each plate from the open pose to fold angles theta (n,), shape (n, 4, 4), by role."""
        start = self._open_frames
        return {role: motion_between(start[role], frame) for role, frame in self.frames(theta).items()}

    def swept(self, theta: FloatArray) -> FloatArray:
        """All corners of all plates at fold angles theta (n,), shape (n, k, 3)."""
        poses = self.poses(theta)
        return np.concatenate([transform(poses[plate.role], plate.outline) for plate in self.plates()], axis=1)

    @classmethod
    def derived(cls, known: Mapping[str, Any]) -> dict[str, Any]:
        """Parameters that follow from those that are `known`, where nobody states them."""
        return {}

    def face_box(self) -> FloatArray:
        """Box around the faces in the open pose, rows low and high, shape (2, 3), mm."""
        corners = np.concatenate([plate.outline for plate in self.plates()])
        return np.array([corners.min(axis=0), corners.max(axis=0)])

    def parameters(self) -> dict[str, Any]:
        """The mechanism's own fields, for design.json."""
        return {own.name: getattr(self, own.name) for own in fields(self) if own.name not in ("id", "pair")}

    def patch_id(self, role: str) -> str:
        """Id that the patch of `role` has in a design; the two stand-ins give the ids of the base pair."""
        if role in (FIRST_BASE, SECOND_BASE):
            return self.pair.patches[role == SECOND_BASE]
        return f"{self.id}.{role}"

    @cached_property
    def _open_frames(self) -> dict[str, Frame]:
        return self.frames(np.array([OPEN]))


@dataclass(frozen=True)
class Recognition:
    """What the patches and hinges of a design say a mechanism is.

    Attributes
    ----------
    mechanism:
        The mechanism with faces as its hinges tell, or None where they do not have its shape.
    conditions:
        The conditions of Sec. 3.3.1 with measured margins; broken ones say why `mechanism` is None.
    roles:
        Role of each of its patches, by patch id.
    """

    mechanism: Mechanism | None
    conditions: tuple[Condition, ...]
    roles: Mapping[str, str] = field(default_factory=dict)

    @staticmethod
    def unlike(subject: str, form: str) -> "Recognition":
        """The patches do not have the form that the mechanism needs."""
        return Recognition(None, (Condition("foldable", subject, f"its form: {form}", -1.0),))


def require_positive(mechanism: Mechanism, **lengths: float) -> None:
    """Raise GeometryError unless all `lengths` are positive and finite."""
    for name, value in lengths.items():
        if not 0 < value < np.inf:
            raise GeometryError(f"{mechanism.id}: {name} of a {mechanism.type} must be positive, not {value:g} mm")


def rectangle(x: tuple[float, float], start: FloatArray, end: FloatArray) -> FloatArray:
    """Rectangle over x between two points of one cross-section, shape (4, 3); their x is not used."""
    low, high = np.array([x[0], 0.0, 0.0]), np.array([x[1], 0.0, 0.0])
    first, second = np.array([0.0, *start[1:]]), np.array([0.0, *end[1:]])
    return np.array([low + first, high + first, high + second, low + second])

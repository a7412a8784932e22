"""What all mechanisms have in common."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.random import Generator

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN
from popsim.geometry.rigid import Frame, motion_between, transform
from popsim.mechanisms.condition import Condition
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind
from popsim.mechanisms.plate import FIRST_BASE, SECOND_BASE, Joint, Plate
from popsim.mechanisms.primitive import Primitive
from popsim.mechanisms.room import Room


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

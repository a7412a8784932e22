"""The models behind design.json. Fields named here are public; other fields are kept as they came."""

from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.plane import Plane

GROUND_ID = "G"
BACKDROP_ID = "B"
FORMAT: Literal["popsim-design"] = "popsim-design"
VERSION: Literal[1] = 1

Point = tuple[float, float, float]
Ring = Annotated[tuple[Point, ...], Field(min_length=3)]
HingeKind = Literal["central", "fold", "glue"]
Identifier = Annotated[str, Field(min_length=1, max_length=100, pattern=r"^[^\s\x00-\x1f\x7f]+$")]
Millimetres = Annotated[float, Field(gt=0)]


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="allow", allow_inf_nan=False)

    def __eq__(self, other: object) -> bool:
        """Equal fields; what was derived and cached does not count."""
        if type(self) is not type(other):
            return NotImplemented
        same = all(getattr(self, name) == getattr(other, name) for name in type(self).model_fields)
        return same and self.model_extra == getattr(other, "model_extra", None)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """A copy with fields of `update`, unchecked; what was derived and cached is derived anew."""
        copied = super().model_copy(update=update, deep=deep)
        for name in copied.__dict__.keys() - type(self).model_fields.keys():
            del copied.__dict__[name]
        return copied

    __hash__ = None  # type: ignore[assignment]  # mechanisms hold dicts, which have no hash


class Source(_Model):
    """The model file a design was made from."""

    file: str
    sha256: str


class Card(_Model):
    """The two pages: x extent along the central fold, depth from the fold to the far edges, paper thickness.

    `reverse` is the colour of the side of all paper that is not printed, as #rrggbb; None for plain paper.
    """

    x: tuple[float, float]
    depth: Millimetres
    thickness: Annotated[float, Field(ge=0)] = 0.25
    reverse: Annotated[str, Field(pattern="^#[0-9a-f]{6}$")] | None = None


class TextureFrame(_Model):
    """Where a patch's texture lies: the lower left corner of the image and its two edges, in mm.

    The image reads properly from the side to which `right` x `up` points; that is the printed side.
    """

    origin: Point
    right: Point
    up: Point


class Patch(_Model):
    """A rigid planar piece of paper: a simple outline (not closed) and holes, in the open pose."""

    id: Identifier
    mechanism: Identifier | None = None
    role: str = ""
    outline: Ring
    holes: tuple[Ring, ...] = ()
    texture: str | None = None
    texture_frame: TextureFrame | None = None

    @cached_property
    def points(self) -> FloatArray:
        """Outline, shape (n, 3)."""
        return locked(self.outline, (None, 3), f"outline of {self.id}")

    @cached_property
    def hole_points(self) -> tuple[FloatArray, ...]:
        """Holes, each of shape (n, 3)."""
        return tuple(locked(hole, (None, 3), f"hole of {self.id}") for hole in self.holes)

    @cached_property
    def plane(self) -> Plane:
        """Plane of the outline; its normal is the side from which the outline runs counterclockwise."""
        return Plane.through(self.points)


class Hinge(_Model):
    """A line along which two patches turn about each other.

    `kind`: "central", "fold" (one piece of paper) or "glue" (a flap). `crease`: where both patches lie in one
    plane in the open pose, the unit normal to the side on which the crease bulges out as the card starts to
    close, seen from their far edges; else None.
    """

    id: Identifier
    patches: tuple[Identifier, Identifier]
    axis: tuple[Point, Point]
    kind: HingeKind
    crease: Point | None = None

    @cached_property
    def points(self) -> FloatArray:
        """Ends of the axis, shape (2, 3)."""
        return locked(self.axis, (2, 3), f"axis of {self.id}")

    @cached_property
    def length(self) -> float:
        """Length of the axis, mm."""
        return float(np.linalg.norm(self.points[1] - self.points[0]))

    def other(self, patch: str) -> str:
        """The patch at the other side of the hinge."""
        first, second = self.patches
        return second if patch == first else first


class MechanismRecord(_Model):
    """What a design says of a mechanism; verification derives what it needs from the patches instead."""

    id: Identifier
    type: str
    base: tuple[Identifier, Identifier]
    patches: tuple[Identifier, ...]
    parameters: dict[str, Any] | None = None
    closing_range: tuple[float, float] | None = None


class Design(_Model):
    """A whole pop-up in the open pose. Use :func:`popsim.design.parse_design` to make one from foreign data."""

    format: Literal["popsim-design"] = FORMAT
    version: Literal[1] = VERSION
    unit: Literal["mm"] = "mm"
    source: Source | None = None
    model_to_card: tuple[tuple[float, float, float, float], ...] | None = Field(
        default=None, min_length=4, max_length=4
    )
    card: Card
    patches: tuple[Patch, ...]
    hinges: tuple[Hinge, ...]
    mechanisms: tuple[MechanismRecord, ...] = ()

    @cached_property
    def patch_by_id(self) -> dict[str, Patch]:
        """Patches by id."""
        return {patch.id: patch for patch in self.patches}

    @cached_property
    def mechanism_by_id(self) -> dict[str, MechanismRecord]:
        """Mechanisms by id."""
        return {mechanism.id: mechanism for mechanism in self.mechanisms}

    @cached_property
    def hinges_by_patch(self) -> dict[str, tuple[Hinge, ...]]:
        """The hinges at each patch."""
        found: dict[str, list[Hinge]] = {patch.id: [] for patch in self.patches}
        for hinge in self.hinges:
            for patch in hinge.patches:
                found[patch].append(hinge)
        return {patch: tuple(hinges) for patch, hinges in found.items()}

    @cached_property
    def owner(self) -> dict[str, str]:
        """Mechanism that each patch belongs to, by patch id; ground and backdrop are not in it."""
        return {patch: mechanism.id for mechanism in self.mechanisms for patch in mechanism.patches}

    @property
    def popup_patches(self) -> tuple[Patch, ...]:
        """All patches but ground and backdrop."""
        return tuple(patch for patch in self.patches if patch.id not in (GROUND_ID, BACKDROP_ID))

"""The models behind a wishes file."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from popsim.design.model import Identifier, Source
from popsim.fitting import Region
from popsim.mesh.alignment import Side

FORMAT: Literal["popsim-wishes"] = "popsim-wishes"
VERSION: Literal[1] = 1

FAR = 1e6
"""mm; ends of a range that is not given."""

Span = tuple[float, float]


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Keep(_Model):
    """A mechanism to keep: an entry of `mechanisms` of a design.json, edited or not.

    `base` names the card's pages ("G", "B") or patches of an earlier entry ("M1.T_G"). `patches` and
    `closing_range` follow from the rest and are not read.
    """

    id: Identifier
    type: str
    base: tuple[Identifier, Identifier]
    parameters: dict[str, Any]
    patches: tuple[Any, ...] | None = None
    closing_range: tuple[Any, ...] | None = None


class Box(_Model):
    """A region of the open pose, card frame, mm; an axis that is not given is endless."""

    x: Span = (-FAR, FAR)
    y: Span = (-FAR, FAR)
    z: Span = (-FAR, FAR)

    def region(self) -> Region:
        """The region, whichever end of a range comes first."""
        return Region(np.sort([self.x, self.y, self.z], axis=1).T)


class PinRecord(_Model):
    """One type of mechanism for a region."""

    type: str
    region: Box


class WishesFile(_Model):
    """A wishes file.

    Attributes
    ----------
    source:
        The model it was written for.
    size:
        Longest side of the model, mm or as a length ("15cm"), at which everything else in the file is stated.
    fold:
        Horizontal side of the model along which the fold runs there; where nothing is said, as without any wishes,
        but never as fitting likes.
    forbid:
        Types of mechanisms.
    most_patches:
        As the option of `popsim design`.
    add:
        Whether anything is added to what is kept.
    keep, keep_out, pin:
        See :class:`popsim.fitting.Wishes`.
    """

    format: Literal["popsim-wishes"] = FORMAT
    version: Literal[1] = VERSION
    source: Source | None = None
    size: float | str | None = None
    fold: Side | None = None
    forbid: tuple[str, ...] = ()
    most_patches: Annotated[int, Field(ge=2)] | None = None
    add: bool = True
    keep: tuple[Keep, ...] = ()
    keep_out: tuple[Box, ...] = ()
    pin: tuple[PinRecord, ...] = ()

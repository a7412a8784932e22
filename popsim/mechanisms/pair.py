"""Base patch pairs: the two patches and the fold line on which a mechanism can stand (Sec. 4.1, Fig. 13)."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Card
from popsim.errors import GeometryError
from popsim.geometry.frame import Side


class PairKind(Enum):
    """How a pair opens.

    An *opening* pair opens by theta: ground and backdrop, or the two tops of a box-fold, which stay parallel to
    them. A *corner* pair opens by alpha = theta / 2: a floor that stays parallel to a page and a wall that stays
    parallel to the bisecting plane.
    """

    OPENING = "opening"
    CORNER = "corner"


@dataclass(frozen=True)
class BasePatchPair:
    """Two patches that share a fold line parallel to the x axis, in skew coordinates (:mod:`popsim.geometry`).

    Attributes
    ----------
    patches:
        Opening: the patch on the ground side, the one on the backdrop side. Corner: floor, wall.
    kind:
        Opening or corner.
    side:
        Corner pairs: the side they lie on. Opening pairs lie on both, and carry GROUND.
    u, v:
        Where the fold line is: along the page and along z, mm. Opening pairs have u = 0.
    x:
        Extent of the pair along the fold line, mm.
    free:
        How far along x the closing range of what stands here may reach, mm; infinite where nothing is near.
    reach:
        How far each patch reaches from the fold line, mm, in the order of `patches`.
    owner:
        Id of the mechanism that offers the pair; None for the card.
    """

    patches: tuple[str, str]
    kind: PairKind
    side: Side
    u: float
    v: float
    x: tuple[float, float]
    reach: tuple[float, float]
    free: tuple[float, float] = (-np.inf, np.inf)
    owner: str | None = None

    def __post_init__(self) -> None:
        if not self.x[0] < self.x[1]:
            raise GeometryError(f"a base patch pair needs an extent along the fold, not {self.x}")
        if self.kind is PairKind.OPENING and self.u != 0:
            raise GeometryError(f"an opening pair lies on the bisecting plane (u = 0), not at u = {self.u:g}")


def card_pair(card: Card) -> BasePatchPair:
    """The first pair of every pop-up: ground and backdrop at the central fold."""
    return BasePatchPair(
        patches=(GROUND_ID, BACKDROP_ID),
        kind=PairKind.OPENING,
        side=Side.GROUND,
        u=0.0,
        v=0.0,
        x=card.x,
        reach=(card.depth, card.depth),
    )

"""What the user may say about fitting."""

from dataclasses import dataclass, field

from popsim.errors import InputError
from popsim.fitting.ransac import Weights
from popsim.fitting.wishes import Wishes

DEAREST, CHEAPEST = 0.03, 0.0008
"""Price of a patch as a share of the solid cells, at detail 0 and 1."""

UNLIKE, LIKE = 0.01, 0.0001
"""Likeness that a patch must bring, at detail 0 and 1."""


@dataclass(frozen=True)
class FitSettings:
    """What the user may say about fitting.

    Attributes
    ----------
    detail:
        0 (few patches) to 1 (many).
    most_patches:
        No prism is placed that would lead to more, ground and backdrop not counted.
    weights:
        Of Eq. 1, by which RANSAC fits prisms.
    wishes:
        What is kept, and what may not be.
    """

    detail: float = 0.5
    most_patches: int = 120
    weights: Weights = field(default_factory=Weights)
    wishes: Wishes = field(default_factory=Wishes)

    def __post_init__(self) -> None:
        if not 0 <= self.detail <= 1:
            raise InputError(f"detail must lie between 0 (few patches) and 1 (many), not {self.detail:g}")
        if self.most_patches < 2:
            raise InputError(f"no pop-up has fewer than 2 patches; most patches is {self.most_patches}")

    @property
    def patch_price(self) -> float:
        """Price of a patch as a share of the solid cells."""
        return float(DEAREST * (CHEAPEST / DEAREST) ** self.detail)

    @property
    def patch_likeness(self) -> float:
        """Likeness that a patch must bring."""
        return float(UNLIKE * (LIKE / UNLIKE) ** self.detail)

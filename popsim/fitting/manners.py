"""Ways to begin a search."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.fitting.candidate import Candidate
from popsim.fitting.combination import Combiner
from popsim.fitting.greedy import Grower, Taste
from popsim.fitting.settings import FitSettings
from popsim.fitting.subject import Subject


@dataclass(frozen=True)
class Manner:
    """One way to begin.

    Attributes
    ----------
    price:
        Factor on the price of patches.
    empty, trust, founded, plain:
        See :class:`popsim.fitting.greedy.Taste`.
    closed:
        By how many cells gaps are closed first: what a lattice or open arches enclose then counts as solid.
    name:
        "profiles"; "layers" where rows have their steps and tops only where the views of the model fall into
        layers (Eq. 3); "ransac" where prisms are fitted to points instead (Eq. 1), at the same price of patches.
    """

    price: float
    empty: float
    trust: float
    founded: bool = True
    plain: bool = False
    closed: int = 0
    name: Literal["profiles", "layers", "ransac"] = "profiles"

    def begun(self, subject: Subject, start: Candidate, settings: FitSettings) -> Candidate:
        """What it leads to from a start."""
        price = self.price * settings.patch_price
        if self.name == "ransac":
            rng = np.random.default_rng(subject.seed)
            return Combiner(subject.points, settings.weights, price, rng).combined(start)
        volume = subject.volume.closed(self.closed) if self.closed else subject.volume
        return Grower(volume, subject.planes, self.taste(subject, settings)).grow(start)

    def taste(self, subject: Subject, settings: FitSettings) -> Taste:
        """What a greedy run in this manner values."""
        return Taste(
            self.price * settings.patch_price,
            self.empty,
            self.trust,
            settings.most_patches,
            self.founded,
            self.plain,
            subject.layers if self.name == "layers" else None,
        )


MANNERS = (
    Manner(1.0, 0.8, 0.6, founded=False),
    Manner(1.0, 0.8, 0.6),
    Manner(0.4, 0.8, 0.6),
    Manner(0.5, 1.2, 0.9),
    Manner(0.4, 0.8, 0.3, closed=5),
    Manner(0.4, 0.8, 0.6, plain=True),
    Manner(0.2, 0.6, 0.9, plain=True),
    Manner(0.4, 0.1, 0.6),
    Manner(0.4, 0.8, 0.6, name="layers"),
    Manner(0.4, 0.8, 0.6, name="ransac"),
)
"""Ways to begin; the first ones win where they lead to the same."""

SECOND = Manner(0.1, 0.8, 0.3, founded=False)
"""How prisms are proposed after refitting, where only the likeness decides."""

"""Several greedy runs, the most promising of them refitted, the best of those completed."""

from collections.abc import Iterator
from dataclasses import dataclass

from popsim.fitting.candidate import Candidate
from popsim.fitting.depths import deepened
from popsim.fitting.greedy import Grower, Taste
from popsim.fitting.refit import Climber, Value
from popsim.fitting.settings import FitSettings
from popsim.fitting.snap import Planes
from popsim.fitting.volume import Volume

PROMISING = 3
"""Starts that are refitted."""

FIRST_BUDGET, LAST_BUDGET = 60, 160
"""Evaluations to refit each of them, and the best."""

FINE_STEPS, FINE_BUDGET = (0.6, 0.25), 80
"""Cells by which borders are moved at last, and evaluations for that."""


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
    """

    price: float
    empty: float
    trust: float
    founded: bool = True
    plain: bool = False
    closed: int = 0

    def taste(self, settings: FitSettings) -> Taste:
        """What a greedy run in this manner values."""
        price = self.price * settings.patch_price
        return Taste(price, self.empty, self.trust, settings.most_patches, self.founded, self.plain)


MANNERS = (
    Manner(1.0, 0.8, 0.6, founded=False),
    Manner(1.0, 0.8, 0.6),
    Manner(0.4, 0.8, 0.6),
    Manner(0.5, 1.2, 0.9),
    Manner(0.4, 0.8, 0.3, closed=5),
    Manner(0.4, 0.8, 0.6, plain=True),
    Manner(0.2, 0.6, 0.9, plain=True),
    Manner(0.4, 0.1, 0.6),
)
"""Ways to begin; the first ones win where they lead to the same."""

SECOND = Manner(0.1, 0.8, 0.3, founded=False)
"""How prisms are proposed after refitting, where only the likeness decides."""


def search(
    start: Candidate, volume: Volume, planes: Planes, value: Value, fine: Value, settings: FitSettings
) -> tuple[Candidate, int] | None:
    """Find the candidate of greatest value that grows from `start` and keeps all conditions.

    `fine` is the same value with more pixels: by it borders find their last place.

    Returns
    -------
    tuple or None
        The candidate and by how many cells gaps were closed to find it, or None where nothing can be placed.
    """
    climber = Climber(value, Grower(volume, planes, SECOND.taste(settings)))
    grown = sorted(_grown(start, volume, planes, value, settings), key=lambda found: -found[0])
    tried = [(climber.refit(state, FIRST_BUDGET), closed) for _, state, closed in grown[:PROMISING]]
    if not tried:
        return None
    best, closed = max(tried, key=lambda entry: value(entry[0]))
    best = deepened(climber.complete(best, LAST_BUDGET), value)
    return Climber(fine, climber.grower).refit(best, FINE_BUDGET, FINE_STEPS), closed


def _grown(
    start: Candidate, volume: Volume, planes: Planes, value: Value, settings: FitSettings
) -> Iterator[tuple[float, Candidate, int]]:
    """What the greedy runs lead to, each once: value, candidate, and closed gaps."""
    seen = set()
    for manner in MANNERS:
        filled = volume.closed(manner.closed) if manner.closed else volume
        state = Grower(filled, planes, manner.taste(settings)).grow(start)
        if state.nodes and state.nodes not in seen:
            seen.add(state.nodes)
            yield value(state), state, manner.closed

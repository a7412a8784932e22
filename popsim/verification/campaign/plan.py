"""Which designs a campaign draws."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.verification.random_designs import FLAWS, RandomDesign, random_design

DEPTH = 4
"""How deep mechanisms are nested at most."""

SIZES = (2, 4, 8, 16, 40)
"""Most mechanisms of a design; drawn with SHARES."""

SHARES = (0.35, 0.35, 0.2, 0.08, 0.02)
"""Small designs find as much as large ones and take less time, so there are more of them."""


@dataclass(frozen=True)
class Task:
    """One design of a campaign; enough to draw it again.

    Attributes
    ----------
    index:
        Its number in the campaign.
    seed, most:
        What :func:`popsim.verification.random_designs.random_design` is asked for.
    flaw:
        None for a valid design, or a name of its FLAWS.
    """

    index: int
    seed: int
    most: int
    flaw: str | None

    def draw(self) -> RandomDesign:
        """The design."""
        return random_design(self.seed, mechanisms=(1, self.most), depth=DEPTH, breaking=self.flaw)


def plan(count: int, seed: int) -> Iterator[Task]:
    """The tasks of a campaign; a longer one begins with the tasks of a shorter one."""
    flaws = list(FLAWS)
    for index in range(count):
        rng = np.random.default_rng([seed, index])
        flaw = flaws[index // 2 % len(flaws)] if index % 2 else None
        most = int(rng.choice(SIZES, p=SHARES))
        yield Task(index, int(rng.integers(2**32)), most, flaw)

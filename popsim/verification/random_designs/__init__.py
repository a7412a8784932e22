"""Random nested designs: valid ones, and ones with exactly one condition broken.

Campaigns of verification and tests are made of them. They use all mechanisms of the registry on all kinds of base
patch pairs; a new mechanism is picked up through :meth:`popsim.mechanisms.Mechanism.random`.
"""

from dataclasses import dataclass

import numpy as np

from popsim.design import Design
from popsim.errors import InputError
from popsim.mechanisms import assemble
from popsim.verification.random_designs.contours import random_shapes, reshaped
from popsim.verification.random_designs.fins import random_fins
from popsim.verification.random_designs.flaws import FLAWS, Flaw
from popsim.verification.random_designs.growth import Limits, grow

__all__ = ["FLAWS", "Flaw", "RandomDesign", "random_design"]

CONTOURED = 0.5
"""How many of the valid designs get contours; the others keep their plain faces."""


@dataclass(frozen=True)
class RandomDesign:
    """A design with what is expected of it.

    Attributes
    ----------
    design:
        The design.
    expected:
        None where it is valid, else the one aspect (foldable, stable, clear, contained) that is broken.
    note:
        In words: how large it is, or what was broken.
    """

    design: Design
    expected: str | None
    note: str


def random_design(
    seed: int, *, mechanisms: tuple[int, int] = (1, 40), depth: int = 4, breaking: str | None = None
) -> RandomDesign:
    """Draw a design; the same seed gives the same design on every machine.

    Parameters
    ----------
    seed:
        Any number from 0.
    mechanisms:
        Least and greatest number of mechanisms; a flaw may need up to three.
    depth:
        How deep they may be nested.
    breaking:
        None for a valid design, or one of :data:`FLAWS`.

    Raises
    ------
    InputError
        There is no such flaw, or so many mechanisms do not fit.
    """
    limits = Limits(*mechanisms, depth)
    rng = np.random.default_rng(seed)
    if breaking is None:
        growth = grow(rng, limits)
        contoured = rng.random() < CONTOURED
        fins = random_fins(rng, growth.parts, growth.card) if contoured else {}
        shapes = random_shapes(rng, growth.parts, fins) if contoured else {}
        note = f"valid, {len(growth.parts)} mechanisms, {len(shapes)} contours, {len(fins) // 2} fins"
        design = assemble(growth.card, growth.parts, fins, checked=False)
        return RandomDesign(reshaped(design, shapes), None, note)
    if breaking not in FLAWS:
        raise InputError(f"there is no flaw {breaking!r}; choose one of {', '.join(FLAWS)}")
    flaw = FLAWS[breaking]
    design, note = flaw.make(rng, limits)
    return RandomDesign(design, flaw.aspect, note)

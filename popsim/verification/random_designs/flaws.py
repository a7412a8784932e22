"""Designs with exactly one condition broken, each in its own way."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy.random import Generator

from popsim.design import Card, Design
from popsim.errors import DesignError, InputError
from popsim.mechanisms import Fault, Mechanism, PairKind, assemble
from popsim.mechanisms.room import draw
from popsim.verification.random_designs.box_flaws import plant_inside_pair, plant_lean, plant_overlap, plant_shear
from popsim.verification.random_designs.growth import TRIES, Growth, Limits, Slot, begin, grow
from popsim.verification.random_designs.spoil import spoil

LEAST_CUT = 3.0
"""mm; by how much a condition is broken at least: ten times the play that paper gives."""

MOST_CUT = 8.0
"""mm; by how much lengths and pages are cut at most."""

Made = tuple[Design, str]


@dataclass(frozen=True)
class Flaw:
    """A way to break one condition.

    Attributes
    ----------
    aspect:
        foldable, stable, clear or contained: what it breaks.
    make:
        Draws a design with it, and says in words what was broken.
    """

    aspect: str
    make: Callable[[Generator, Limits], Made]


def _planted(plant: Callable[[Growth, Slot], str | None]) -> Callable[[Generator, Limits], Made]:
    """A flaw that is planted among valid neighbours, on any opening pair where it fits."""

    def make(rng: Generator, limits: Limits) -> Made:
        for _ in range(TRIES):
            growth, count = begin(rng, limits)
            growth.fill(int(rng.integers(0, max(count // 2, 1))))
            sites = [slot for slot in growth.slots if slot.pair.kind is PairKind.OPENING]
            for k in rng.permutation(len(sites)):
                note = plant(growth, sites[k])
                if note is not None:
                    growth.slots.remove(sites[k])
                    growth.fill(count)
                    return assemble(growth.card, growth.parts, checked=False), note
        raise _no_room(limits)

    return make


def _make_lengths(rng: Generator, limits: Limits) -> Made:
    """A random mechanism gets one line shifted, on which nothing stands."""
    for _ in range(TRIES):
        growth = grow(rng, limits)
        sites = [
            (part, fault)
            for part in growth.parts
            for fault in part.faults()
            if fault.most >= LEAST_CUT and not _bears(growth, part, fault)
        ]
        if sites:
            part, fault = sites[int(rng.integers(len(sites)))]
            by = draw(rng, LEAST_CUT, min(fault.most, MOST_CUT))
            try:
                design = spoil(assemble(growth.card, growth.parts, checked=False), part, fault, by)
            except DesignError:
                continue
            return design, f"{fault.identity} of {part.id} is off: a line shifted by {by:g} mm"
    raise _no_room(limits)


def _make_tall(rng: Generator, limits: Limits) -> Made:
    """The page ends short of the closed extent of the tallest, but not of what is glued to it."""
    for _ in range(TRIES):
        growth = grow(rng, limits)
        tallest = max(growth.parts, key=lambda part: part.closed_extent())
        least = max(abs(float(y)) for part in growth.parts for plate in part.plates() for y in plate.outline[:, 1])
        most = min(tallest.closed_extent() - least, MOST_CUT)
        if most >= LEAST_CUT:
            by = draw(rng, LEAST_CUT, most)
            card = _cut(growth.card, depth=tallest.closed_extent() - by)
            return assemble(
                card, growth.parts, checked=False
            ), f"{tallest.id} sticks {by:g} mm out of the closed page"
    raise _no_room(limits)


def _make_wide(rng: Generator, limits: Limits) -> Made:
    """The page ends short of the range of the foremost, but not of what is glued to it."""
    for _ in range(TRIES):
        growth = grow(rng, limits)
        foremost = max(growth.parts, key=lambda part: part.closing_range()[1])
        edge = foremost.closing_range()[1]
        least = max(float(x) for part in growth.parts for plate in part.plates() for x in plate.outline[:, 0])
        most = min(edge - least, MOST_CUT)
        if most >= LEAST_CUT:
            by = draw(rng, LEAST_CUT, most)
            card = _cut(growth.card, x=(growth.card.x[0], edge - by))
            return assemble(
                card, growth.parts, checked=False
            ), f"{foremost.id} sticks {by:g} mm out beside the closed page"
    raise _no_room(limits)


def _bears(growth: Growth, part: Mechanism, fault: Fault) -> bool:
    """Whether anything stands on the plates that a fault moves."""
    moving = {part.patch_id(role) for role in fault.roles}
    return any(moving.intersection(other.pair.patches) for other in growth.parts)


def _cut(card: Card, *, depth: float | None = None, x: tuple[float, float] | None = None) -> Card:
    return Card(x=x or card.x, depth=depth or card.depth, thickness=card.thickness)


def _no_room(limits: Limits) -> InputError:
    return InputError(f"no design of at most {limits.most} mechanisms has room for this flaw; ask for more")


FLAWS: dict[str, Flaw] = {
    "shear": Flaw("stable", _planted(plant_shear)),
    "lengths": Flaw("foldable", _make_lengths),
    "overlap": Flaw("clear", _planted(plant_overlap)),
    "lean": Flaw("clear", _planted(plant_lean)),
    "inside-pair": Flaw("clear", _planted(plant_inside_pair)),
    "tall": Flaw("contained", _make_tall),
    "wide": Flaw("contained", _make_wide),
}
"""The flaws by name."""

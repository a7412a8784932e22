"""Growing a nested design on a card, valid by construction."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.random import Generator

from popsim.design import Card
from popsim.errors import InputError
from popsim.mechanisms import (
    MECHANISMS,
    BasePatchPair,
    Mechanism,
    PairKind,
    Room,
    card_pair,
)
from popsim.mechanisms.room import LEAST, draw

GAP = 1.0
"""mm; what is left between the rooms of neighbours, and to the edges of the page."""

OPENING_FIRST = 0.6
"""How often an opening pair is filled first where there is one."""

TRIES = 40
"""How often a design is begun anew that came out smaller than asked for."""


@dataclass(frozen=True)
class Limits:
    """How many mechanisms a design may have, and how deep they may be nested."""

    least: int
    most: int
    depth: int

    def __post_init__(self) -> None:
        if not 1 <= self.least <= self.most or self.depth < 1:
            raise InputError(f"designs need mechanisms, not {self.least} to {self.most} to depth {self.depth}")


@dataclass(frozen=True)
class Slot:
    """A pair with room for one more mechanism, at a depth of nesting."""

    pair: BasePatchPair
    room: Room
    level: int


@dataclass
class Growth:
    """A card on which mechanisms are placed one after the other, each with room of its own.

    Rooms of neighbours are disjoint and those of children lie within their parent's, so the ranges of whole
    subtrees never overlap.
    """

    rng: Generator
    card: Card
    depth: int
    parts: list[Mechanism] = field(default_factory=list)
    slots: list[Slot] = field(default_factory=list)

    def open_card(self, count: int) -> None:
        """Divide the central fold among about as many mechanisms as `count` asks for."""
        (low, high), extent = self.card.x, self.card.depth - GAP
        self.divide(card_pair(self.card), Room((low + GAP, high - GAP), extent), 1, 1 + count // 4)

    def divide(self, pair: BasePatchPair, room: Room, level: int, most: int) -> None:
        """Give the room on a pair to at most `most` slots side by side."""
        room = room.within(*pair.free)
        low, high = room.x
        parts = min(int(self.rng.integers(1, most + 1)), int((high - low) // (2 * LEAST + GAP)))
        if parts < 1 or level > self.depth:
            return
        cuts = np.linspace(low, high, parts + 1)
        wobble = (high - low - parts * (2 * LEAST + GAP)) / parts / 2
        cuts[1:-1] += [draw(self.rng, -wobble, wobble) for _ in range(parts - 1)]
        for k in range(parts):
            ends = (float(cuts[k]) + (k > 0) * GAP / 2, float(cuts[k + 1]) - (k < parts - 1) * GAP / 2)
            self.slots.append(Slot(pair, replace(room, x=ends), level))

    def fill(self, count: int) -> None:
        """Fill slots at random until there are `count` mechanisms or no slots."""
        while self.slots and len(self.parts) < count:
            slot = self.slots.pop(self.choose())
            mechanism = self.place(slot, bearing=count - len(self.parts) > len(self.slots))
            if mechanism is not None:
                self.add(mechanism, slot)

    def choose(self) -> int:
        """Index of the next slot; opening pairs come first more often, as there are more corners."""
        opening = [k for k, slot in enumerate(self.slots) if slot.pair.kind is PairKind.OPENING]
        if opening and self.rng.random() < OPENING_FIRST:
            return opening[int(self.rng.integers(len(opening)))]
        return int(self.rng.integers(len(self.slots)))

    def place(self, slot: Slot, *, bearing: bool = False) -> Mechanism | None:
        """Draw a mechanism of any type; `bearing` prefers those that others can stand on."""
        drawn = None
        for kind in self.kinds(slot.pair.kind):
            found = kind.random(self.rng, slot.pair, self.next_id(), slot.room)
            if found is not None and (not bearing or found.pairs()):
                return found
            drawn = drawn or found
        return drawn

    def next_id(self, ahead: int = 1) -> str:
        """Id of the next mechanism, or of a later one."""
        return f"M{len(self.parts) + ahead}"

    def kinds(self, pair: PairKind) -> list[type[Mechanism]]:
        """The types that can stand on a kind of pair, in random order."""
        fitting = [kind for kind in MECHANISMS.values() if kind.pair_kind is pair]
        return [fitting[k] for k in self.rng.permutation(len(fitting))]

    def add(self, mechanism: Mechanism, slot: Slot) -> None:
        """Take up a mechanism and divide what it offers."""
        self.parts.append(mechanism)
        for pair, room in rooms_on(mechanism, slot.room):
            self.divide(pair, room, slot.level + 1, 2)


def rooms_on(mechanism: Mechanism, room: Room) -> Iterator[tuple[BasePatchPair, Room]]:
    """The pairs that a mechanism offers, each with its part of the room; opening pairs do not share any."""
    offered = mechanism.pairs()
    for pair in offered:
        others = [other.x for other in offered if other.kind is pair.kind and other is not pair]
        middle = sum(pair.x) / 2
        low = max((x[1] for x in others if sum(x) / 2 < middle), default=-np.inf)
        high = min((x[0] for x in others if sum(x) / 2 > middle), default=np.inf)
        yield pair, room.within(low, high) if pair.kind is PairKind.OPENING else room


def random_card(rng: Generator, count: int) -> Card:
    """A card with room for about `count` mechanisms."""
    half = draw(rng, 60, 120) * (1 + count / 12)
    return Card(x=(round(-half, 1), round(half, 1)), depth=round(draw(rng, 90, 200), 1))


def begin(rng: Generator, limits: Limits) -> tuple[Growth, int]:
    """An empty card with its first slots, and how many mechanisms it is to get."""
    count = int(rng.integers(limits.least, limits.most + 1))
    growth = Growth(rng, random_card(rng, count), limits.depth)
    growth.open_card(count)
    return growth, count


def grow(rng: Generator, limits: Limits) -> Growth:
    """Grow a valid design.

    Raises
    ------
    InputError
        So many mechanisms do not fit, even after many tries.
    """
    for _ in range(TRIES):
        growth, count = begin(rng, limits)
        growth.fill(count)
        if len(growth.parts) >= limits.least:
            return growth
    raise InputError(f"{limits.least} mechanisms to depth {limits.depth} do not fit on a card; ask for fewer")

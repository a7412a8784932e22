"""Mechanisms drawn by chance on any kind of pair, with what they stand on: the material of the law tests."""

from dataclasses import dataclass

import numpy as np

from popsim.design import Card, Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import Side, page_poses
from popsim.mechanisms import (
    MECHANISMS,
    BasePatchPair,
    Mechanism,
    Room,
    assemble,
    card_pair,
)

CARD = Card(x=(-160.0, 160.0), depth=190.0)
ROOM = Room((-155.0, 155.0), 185.0)


@dataclass(frozen=True)
class Drawn:
    """A mechanism, the hosts it stands on from the card upwards, and the room it was given."""

    mechanism: Mechanism
    hosts: tuple[Mechanism, ...]
    room: Room

    @property
    def design(self) -> Design:
        return assemble(CARD, [*self.hosts, self.mechanism])

    def poses(self, theta: FloatArray) -> dict[str, FloatArray]:
        """Closed-form motion of all patches, pages included, (n, 4, 4), by patch id."""
        poses = {"G": page_poses(Side.GROUND, theta), "B": page_poses(Side.BACKDROP, theta)}
        for part in (*self.hosts, self.mechanism):
            poses |= {part.patch_id(role): motion for role, motion in part.poses(theta).items()}
        return poses


def draw_mechanism(kind: type[Mechanism], seed: int) -> Drawn:
    """A mechanism of a type on the card, or on pairs that up to two others offer."""
    rng = np.random.default_rng(seed)
    while True:
        pair: BasePatchPair = card_pair(CARD)
        hosts: list[Mechanism] = []
        for _ in range(int(rng.integers(3))):
            host = _any_on(rng, pair, f"M{len(hosts) + 1}")
            if host is None or not host.pairs():
                break
            hosts.append(host)
            pair = host.pairs()[rng.integers(len(host.pairs()))]
        if pair.kind is kind.pair_kind:
            room = ROOM.within(*pair.free)
            mechanism = kind.random(rng, pair, f"M{len(hosts) + 1}", room)
            if mechanism is not None:
                return Drawn(mechanism, tuple(hosts), room)


def _any_on(rng: np.random.Generator, pair: BasePatchPair, name: str) -> Mechanism | None:
    kinds = [kind for kind in MECHANISMS.values() if kind.pair_kind is pair.kind]
    return kinds[rng.integers(len(kinds))].random(rng, pair, name, ROOM.within(*pair.free))

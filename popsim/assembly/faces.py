"""Which face of what is in hand is up: a step that is done from the other side costs a turn of the whole thing."""

from collections.abc import Iterable

import numpy as np

from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof
from popsim.assembly.reference import STACKED


class Faces:
    """Which side of the folded stack was up when parts were last worked on, going through an order backwards."""

    def __init__(self, kit: Kit) -> None:
        self._kit = kit
        self._up: dict[int, frozenset[str]] = {1: frozenset(), -1: frozenset()}

    def note(self, proof: Proof) -> None:
        """Note a step, of the parts that keep still in it; where something is only swung aside nothing is done."""
        still = {name: side for name, side in sides(self._kit, proof).items() if name not in proof.movers}
        for side in self._up if proof.joints else ():
            own = frozenset(name for name, up in still.items() if up == side)
            self._up[side] = self._up[side].difference(still) | own

    def is_turned(self, bundle: Bundle, cut: Cut) -> bool:
        """Whether more of what is at hand must be turned over than not, if `cut` is what is done before."""
        side = cut.side if self._moves(bundle, cut) else -cut.side
        return len(self._up[-side] & bundle.parts) > len(self._up[side] & bundle.parts)

    def _moves(self, bundle: Bundle, cut: Cut) -> bool:
        """Whether it is the moved side that is moved by hand, not the rest: see :meth:`Bundle.lighter`."""
        if self._kit.grounds & bundle.parts:
            return self._kit.grounds.isdisjoint(cut.moved)
        return 2 * len(cut.moved) <= len(bundle.parts)


def sides(kit: Kit, proof: Proof) -> dict[str, int]:
    """1 where a part is worked on from the upper side of the folded stack, -1 where from below, by id."""
    found = {}
    for name, poses in proof.motion.items():
        stacked = poses[-1][:3, :3] @ kit.reference.flat[name][:3, :3].T @ STACKED
        found[name] = int(np.sign(round(float(stacked @ proof.up), 6)))
    return found


def turns(kit: Kit, order: Iterable[Proof]) -> int:
    """How often something is turned over between the steps of an order, from the first to the last."""
    count = 0
    up: dict[str, int] = {}
    for proof in order:
        if proof.joints:
            now = sides(kit, proof)
            known = [up[name] * side for name, side in now.items() if name in up and name not in proof.movers]
            count += sum(known) < 0
            up |= now
    return count

"""Executing a step with everything lying: something is laid, slid in or folded over, and pressed down flat.

A step is looked at from its end: what is undone by a motion is made by the same motion backwards.
"""

from functools import cached_property, partial

import numpy as np

from popsim import wording
from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut, cuts
from popsim.assembly.glueing import Glueing, Poses
from popsim.assembly.passage import Pair, Passage
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.scene import FlapKey, flap_key
from popsim.assembly.stack import Stack
from popsim.assembly.way import Way
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import turns_about

LOOK = 15.0
"""mm between the two sides of a joint when the eye last guides them."""

SHOWN = 0.5
"""How far away a piece is shown before it is laid, over its size."""

FOLDED_OVER = (172.0, 120.0, 75.0)
"""Degrees by which what is folded over something is opened, the first that goes; without the last none does."""

BESIDE = (75.0, 40.0)
"""The same for what lies on the other side of the line."""

FINE = np.radians(10.0)
"""rad; turns are sampled at least this finely."""

LEVEL = 0.9
"""Cosine of the greatest angle between two sides that are pressed flat onto each other."""

ALONG = ((0, 0, -1), (0, 0, 1), (1, 0, 0), (-1, 0, 0))
"""Directions within the folded stack from which something is slid in: from the fold of the card first."""


class Trial:
    """A bundle of which something is to be undone while it lies; `number` is that of what is swung aside next."""

    def __init__(self, bundle: Bundle, stack: Stack, number: int) -> None:
        self.bundle, self.stack, self.number = bundle, stack, number
        self.kit = bundle.kit
        self._tried: dict[Cut, Proof | Refusal] = {}

    @cached_property
    def cuts(self) -> tuple[Cut, ...]:
        """All ways to take it apart or to open it."""
        return tuple(cuts(self.bundle, self.stack))

    def cut(self, cut: Cut) -> Proof | Refusal:
        """Take it apart or open it; what was tried before is remembered."""
        if cut not in self._tried:
            self._tried[cut] = self._shut_off(cut) or (self._opened(cut) if cut.line else self._lifted(cut))
        return self._tried[cut]

    def slid(self, moved: frozenset[str]) -> Proof | Refusal:
        """Pull some parts out along the plane in which they lie."""
        taken = tuple(joint.id for joint in self.bundle.crossing(moved))
        if not set(taken) <= set(self.kit.flaps_of):
            return Refusal(taken, wording.ONE_PIECE)
        for flap in self._glueing(taken).flaps:
            covering = self._covering(flap_key(flap), self.bundle.parts)
            if covering:
                return Refusal(taken, wording.WIPED_OFF.format(other=covering[0]), covering)
        turn = self.bundle.turn(min(moved))
        for direction in np.array(ALONG, dtype=np.float64):
            if not self._hit(moved, turn @ direction):
                return self._apart(moved, taken, turn @ direction, Way.SLID)
        return Refusal(taken, wording.NOT_SLID)

    def _lifted(self, cut: Cut) -> Proof | Refusal:
        flaps = self._glueing(cut.taken).flaps
        for flap in flaps:
            one, other = (self.bundle.normal(name) for name in (flap.carrier, flap.target))
            if abs(one @ other) < LEVEL:
                return Refusal(cut.taken, wording.NOT_LEVEL.format(carrier=flap.carrier, target=flap.target))
        direction = cut.side * self.bundle.up(flaps[0].target)
        hit = self._hit(cut.moved, direction)
        if hit:
            return Refusal(cut.taken, wording.LAID_INTO.format(other=hit[0][1]), _others(hit))
        return self._apart(cut.moved, cut.taken, direction, Way.LAID)

    def _opened(self, cut: Cut) -> Proof | Refusal:
        bundle, rest = self.bundle, self.bundle.parts - cut.moved
        joint = bundle.joints[cut.line[0]]
        ends = bundle.axis(joint)
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        up = cut.side * bundle.up(joint.parts[0])
        lever, other = (np.cross(along, bundle.middle(group) - ends[0]) @ up for group in (cut.moved, rest))
        *wider, least = FOLDED_OVER if lever * other > 0 else BESIDE
        turned = partial(self._turned, cut.moved, along, ends[0], float(np.sign(lever)))
        narrow = turned(least)
        if hit := narrow[2]:
            return Refusal(cut.taken, wording.FOLDED_INTO.format(other=hit[0][1]), _others(hit))
        turns, motion, _ = next((one for one in map(turned, wider) if not one[2]), narrow)
        left = bundle.without(cut.taken).swung(cut.moved, turns[0], self.number)
        blind = self._glueing(cut.taken).unseen(bundle.poses, left.poses)
        movers = bundle.lighter(cut.moved)
        if movers != cut.moved:
            back, up = np.linalg.inv(turns), -up
            motion = {name: back @ poses for name, poses in motion.items()}
        return Proof(Way.FOLDED, cut.taken, blind, motion, movers, up, (left,))

    def _turned(
        self, moved: frozenset[str], along: FloatArray, point: FloatArray, sense: float, degrees: float
    ) -> tuple[FloatArray, Poses, list[Pair]]:
        """Turns (k, 4, 4) about a line from so many degrees to none, the motion of all parts, and what it hits."""
        steps = np.linspace(np.radians(degrees), 0.0, int(np.ceil(np.radians(degrees) / FINE)) + 1)
        turns = turns_about(along, point, sense * steps)
        motion = {
            name: turns @ pose if name in moved else np.broadcast_to(pose, turns.shape)
            for name, pose in self.bundle.poses.items()
        }
        return turns, motion, self.kit.swings.collisions(moved, turns, self.bundle.poses)

    def _apart(self, moved: frozenset[str], taken: tuple[str, ...], direction: FloatArray, way: Way) -> Proof:
        """The proof that two bundles come together along a straight line; the lighter one is moved in pictures."""
        bundle, movers = self.bundle, self.bundle.lighter(moved)
        toward = direction if movers == moved else -direction
        shown = SHOWN * self.kit.size({name: bundle.poses[name] for name in movers})
        stages = [bundle.shifted(movers, share * shown * toward) for share in (1.0, 0.5, 0.0)]
        motion = {name: np.stack([stage[name] for stage in stages]) for name in bundle.poses}
        blind = self._glueing(taken).unseen(bundle.poses, bundle.shifted(movers, LOOK * toward))
        left = bundle.without(taken)
        apart = left.only(bundle.parts - moved), left.only(moved)
        return Proof(way, taken, blind, motion, movers, toward, apart)

    def _shut_off(self, cut: Cut) -> Refusal | None:
        """Why a flap of a cut cannot get to its place, if it cannot.

        Where a flap comes onto its place with one side, nothing of the other side may lie there. Where it would
        have to get behind its place, it is folded onto it in the end: then nothing at all may lie there.
        """
        rest = self.bundle.parts - cut.moved
        for flap in self._glueing(cut.taken).flaps:
            key, lands = flap_key(flap), flap.target in cut.moved
            comes_onto = (self.stack.side(key) == cut.side) != lands
            own = cut.moved if lands else rest
            covering = self._covering(key, own if comes_onto else self.bundle.parts)
            if covering:
                reason = wording.NOT_BETWEEN.format(carrier=flap.carrier, target=flap.target, other=covering[0])
                return Refusal(cut.taken, reason, covering)
        return None

    def _covering(self, key: FlapKey, among: frozenset[str]) -> tuple[str, ...]:
        """Parts that lie on the place of a flap."""
        sheets = self.bundle.sheets
        sheet = sheets[self.kit.flap_motions[key].flap.target]
        return tuple(sorted(name for name in self.stack.covers[key] & among if sheets[name] == sheet))

    def _hit(self, moved: frozenset[str], direction: FloatArray) -> list[Pair]:
        """What some parts run into as they come from a direction (3,)."""
        near: Poses = self.bundle.poses
        far = self.bundle.shifted(moved, self.kit.size(near) * direction)
        motion = {name: np.stack([far[name], near[name]]) for name in near}
        return Passage(self.kit.outlines, motion).collisions(sorted(moved), sorted(self.bundle.parts - moved))

    def _glueing(self, taken: tuple[str, ...]) -> Glueing:
        return Glueing(self.kit, taken)


class Trials:
    """The trials of one step, each made once: what can be done at once is asked from several sides."""

    def __init__(self, stack: Stack) -> None:
        self._stack = stack
        self._made: dict[tuple[Bundle, int], Trial] = {}

    def of(self, bundle: Bundle, number: int) -> Trial:
        """The trial of a bundle; `number` is that of what is swung aside next."""
        if (bundle, number) not in self._made:
            self._made[bundle, number] = Trial(bundle, self._stack, number)
        return self._made[bundle, number]


def _others(hit: list[Pair]) -> tuple[str, ...]:
    return tuple(sorted({other for _, other in hit}))

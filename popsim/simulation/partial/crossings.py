"""How deep parts run through each other on the way, asked again and again of structures that grow."""

from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.simulation.candidates import candidate_pairs
from popsim.simulation.collisions import SKIN
from popsim.simulation.mjcf import size_of
from popsim.simulation.partial.on_line import OnLine
from popsim.simulation.passing import passing_depths
from popsim.simulation.plates import prisms
from popsim.simulation.scene import Scene
from popsim.simulation.sweep import Sweep

TOUCH = 0.01
"""mm; plates that run through each other by less than this only touch."""

ALIKE = 1e-5
"""mm, and share of a turn; two parts that lie to each other as before by this much cross as before."""

Pair = tuple[str, str]


class Crossings:
    """All parts of a design as plates that MuJoCo collides; what was measured once is remembered.

    A part that moves with others does so in every structure that has them: of two parts that lie to each other as
    at the same angle before, nothing new is to be found.
    Parts that have a hinge line in common touch there for as long as they meet on it, joined or not yet: planes
    meet on one line only, so what counts then is whether they turn through each other. Off it they are asked for
    as all others are.
    """

    def __init__(self, design: Design) -> None:
        self._scale = size_of(design)
        self._skin = SKIN * self._scale
        self._place = {patch.id: k for k, patch in enumerate(design.patches)}
        self._scene = Scene({k: prisms(p, self._scale, SKIN) for k, p in enumerate(design.patches)}, self._scale)
        self._on_line = OnLine(design)
        self._known: dict[tuple[Pair, float], tuple[FloatArray, float]] = {}

    def deepest(self, sweep: Sweep) -> tuple[float, Pair | tuple[()]]:
        """The deepest crossing in a motion of some parts, mm, but for its last, flat pose; and of which parts."""
        met = self._on_line.met(sweep)
        found = self._passing(sweep, met)
        for frame, pairs in self._candidates(sweep, met).items():
            depths = self._depths(sweep, frame, pairs)
            pair = max(pairs, key=lambda pair: depths[pair])
            if depths[pair] > max(found[0], TOUCH):
                found = depths[pair], pair
        return found

    def _passing(self, sweep: Sweep, met: Mapping[frozenset[str], BoolArray]) -> tuple[float, Pair | tuple[()]]:
        """How far two parts that meet on one line pass each other at their far edges, mm; and which."""
        turns = [turn for pair in met if met[pair].any() and (turn := self._on_line.turn(pair)) is not None]
        meets = np.array([met[frozenset(turn.hinge.patches)] for turn in turns]).reshape(len(turns), -1).T
        depths = np.where(meets, passing_depths(sweep, turns), 0.0)[:-1].max(axis=0, initial=0.0)
        if depths.max(initial=0.0) < TOUCH:
            return 0.0, ()
        first, second = turns[int(depths.argmax())].hinge.patches
        return float(depths.max()), (first, second)

    def _depths(self, sweep: Sweep, frame: int, pairs: list[Pair]) -> dict[Pair, float]:
        """How deep some pairs run through each other at a recorded angle, mm."""
        poses, theta = sweep.poses[frame], float(sweep.theta[frame])
        first, second = (poses[[sweep.index[pair[side]] for pair in pairs]] for side in (0, 1))
        lying = dict(zip(pairs, np.linalg.inv(first) @ second, strict=True))
        fresh = [pair for pair in pairs if not self._is_known(pair, theta, lying[pair])]
        if fresh:
            self._put(sweep, frame)
        for pair in fresh:
            self._known[pair, theta] = lying[pair], self._depth(pair)
        return {pair: self._known[pair, theta][1] for pair in pairs}

    def _candidates(self, sweep: Sweep, met: Mapping[frozenset[str], BoolArray]) -> dict[int, list[Pair]]:
        patches = sweep.design.patches
        found: dict[int, list[Pair]] = defaultdict(list)
        for candidate in candidate_pairs(sweep, np.arange(len(sweep.theta) - 1), TOUCH):
            first, second = (patches[k].id for k in candidate.pair)
            meets = met.get(frozenset((first, second)))
            for frame in candidate.angles:
                if meets is None or not meets[frame]:
                    found[frame].append((first, second))
        return dict(sorted(found.items()))

    def _is_known(self, pair: Pair, theta: float, lying: FloatArray) -> bool:
        known = self._known.get((pair, theta))
        return known is not None and float(np.abs(known[0] - lying).max()) < ALIKE

    def _put(self, sweep: Sweep, frame: int) -> None:
        poses = np.tile(np.eye(4), (len(self._place), 1, 1))
        poses[[self._place[patch.id] for patch in sweep.design.patches]] = sweep.poses[frame]
        self._scene.place(poses)

    def _depth(self, pair: Pair) -> float:
        first, second = (self._place[name] for name in pair)
        return max(-(self._scene.distance(first, second, self._skin) + 2 * self._skin), 0.0)

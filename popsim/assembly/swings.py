"""What runs into what while something is swung about a line, asked again after each joint that is undone."""

from collections.abc import Mapping

import numpy as np

from popsim.assembly.outline import Outline
from popsim.assembly.passage import Pair, Passage
from popsim.geometry.arrays import FloatArray

Poses = Mapping[str, FloatArray]

Swing = tuple[frozenset[str], bytes, bytes]
"""The parts that are swung, how, and where they lie."""


class Swings:
    """Swings of some parts past others; what was found of two parts is remembered for as long as both lie so.

    `outlines` are those of all parts, by id.
    """

    def __init__(self, outlines: Mapping[str, Outline]) -> None:
        self._outlines = outlines
        self._known: dict[Swing, dict[str, tuple[bytes, list[Pair]]]] = {}

    def collisions(self, moved: frozenset[str], turns: FloatArray, poses: Poses) -> list[Pair]:
        """Pairs of a part of `moved` and another that go through each other, in order.

        Parameters
        ----------
        moved:
            Ids of the parts that are swung.
        turns:
            How they are, shape (k, 4, 4).
        poses:
            Motion of these and all others from the open pose to where they lie, by part id, each of shape (4, 4).
        """
        own = sorted(moved)
        known = self._known.setdefault(
            (moved, turns.tobytes(), b"".join(poses[name].tobytes() for name in own)), {}
        )
        places = {name: pose.tobytes() for name, pose in poses.items() if name not in moved}
        fresh = sorted(name for name, place in places.items() if name not in known or known[name][0] != place)
        if fresh:
            motion = {name: turns @ poses[name] for name in own}
            motion |= {name: np.broadcast_to(poses[name], turns.shape) for name in fresh}
            hit = Passage(self._outlines, motion).collisions(own, fresh)
            for name in fresh:
                known[name] = places[name], [pair for pair in hit if pair[1] == name]
        return sorted(pair for name in places for pair in known[name][1])

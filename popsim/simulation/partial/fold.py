"""Folding a partial structure from where it is open to where it lies flat."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.simulation.extents import flatness
from popsim.simulation.gaps import loop_gaps
from popsim.simulation.partial.crossings import Crossings
from popsim.simulation.partial.rig import PartialRig
from popsim.simulation.partial.structure import Structure
from popsim.simulation.sweep import Sweep

LEG, END_LEG = 3.0, 0.5
"""Degrees by which hands lead on at once, and the same within END of either end, where poses are singular."""

END = 10.0
"""Degrees; within this of 180 and 0 hands lead slowly."""

SETTLED = 1e-8
"""rad; hands rest at each recorded angle until no joint turns by more than this in a step."""

BRIEFLY, PATIENCE = 3, 8
"""Steps from rest in which hands rest on the way, and at recorded angles, at most: each is a Gauss-Newton step,
and takes off but half of what is left near flat poses. What they leave is polished off at recorded angles."""

FREE_AT = np.pi / 2
"""rad; fold angle nearest to which free motions are counted: far from the flat poses, where there are more."""


@dataclass(frozen=True, eq=False)
class PartialFold:
    """What a partial structure did on its way from open to flat.

    Attributes
    ----------
    sweep:
        Its motion, in the frame in which it was led; the last pose is the flat one.
    led:
        Ids of the hinges that hands led; nothing else was moved by anything but the loops.
    gap:
        How far any loop opened at most, mm.
    thickness:
        Greatest height over the plane in which it should lie in the end, mm.
    crossing:
        How deep two parts ran through each other at most, mm; 0 where none did.
    crossed:
        Ids of these two; empty where there are none.
    """

    sweep: Sweep
    led: tuple[str, ...]
    gap: float
    thickness: float
    crossing: float
    crossed: tuple[str, ...]


def fold_partial(structure: Structure, crossings: Crossings, theta: FloatArray, poses: FloatArray) -> PartialFold:
    """Lead a structure through recorded fold angles, down to where all lies flat in the plane y = 0.

    Parameters
    ----------
    structure:
        Parts and joints; they hang together.
    crossings:
        Of a design with all these parts.
    theta:
        Fold angles of the finished pop-up, rad, from nearly open to 0, shape (n,).
    poses:
        Motion of each part from the open pose at these, in the order of the structure, shape (n, p, 4, 4). The
        root is put there, and the angles of hinges that hands lead are taken from it; nothing else is.
    """
    rig = PartialRig(structure)
    angles = rig.angles(poses)
    rig.start(angles[np.abs(theta - FREE_AT).argmin()])
    led = rig.led()
    rig.start(angles[0])
    rig.hold(led)
    root = [patch.id for patch in structure.design.patches].index(structure.root)
    found, way = [], _Way(rig)
    for held, leg in zip(poses[:, root], _legs(theta, angles), strict=True):
        rig.put(held)
        for degree, target in leg:
            way.onward(degree)
            rig.lead(target)
            rig.rest(BRIEFLY, SETTLED)
            way.been(degree)
        rig.rest(PATIENCE, SETTLED)
        rig.polish(leg[-1][1])
        way.been(leg[-1][0])
        found.append(rig.poses())
    rig.flatten()
    found[-1] = rig.poses()
    sweep = Sweep(structure.design, theta, np.array(found), np.zeros((len(theta), 0)), complete=True)
    crossing, crossed = crossings.deepest(sweep)
    gap = loop_gaps(sweep, rig.forest.loops).largest
    names = tuple(rig.turning[k].hinge.id for k in led)
    return PartialFold(sweep, names, gap, flatness(sweep).value, crossing, crossed)


def _legs(theta: FloatArray, angles: FloatArray) -> Iterator[list[tuple[float, FloatArray]]]:
    """By which fold angles, degrees, and to which angles of the joints (j,) hands lead until each recorded one."""
    degrees = np.degrees(theta)
    for k, degree in enumerate(degrees):
        before = max(k - 1, 0)
        at_end = min(degree, 180 - degrees[before]) < END
        parts = max(int(np.ceil((degrees[before] - degree) / (END_LEG if at_end else LEG))), 1)
        share = np.arange(1, parts + 1)[:, None] / parts
        targets = angles[before] * (1 - share) + angles[k] * share
        yield list(
            zip((degrees[before] + share[:, 0] * (degree - degrees[before])).tolist(), targets, strict=True)
        )


class _Way:
    """Where the joints of a rig have been: at each next fold angle they are looked for straight on."""

    def __init__(self, rig: PartialRig) -> None:
        self._rig = rig
        self._been: list[tuple[float, FloatArray]] = []

    def onward(self, degree: float) -> None:
        """Take the joints on as they came, to where they would be at a fold angle, degrees."""
        if len(self._been) > 1:
            (first, one), (second, other) = self._been[-2:]
            self._rig.start(other + (other - one) * (degree - second) / (second - first))

    def been(self, degree: float) -> None:
        """Note where they are at a fold angle, degrees."""
        if self._been and self._been[-1][0] == degree:
            self._been.pop()
        self._been.append((degree, self._rig.now))

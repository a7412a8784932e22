"""Flaps for all joints that are no folds: which part carries each, how it is shaped, where it lands (Sec. 4.4).

All is planned before pieces are placed on sheets. For each stretch of each glue joint every site is tried: the
flap is trimmed to stay off its own piece and its other flaps, and inside its target, off what else lands or stands
there. The site that leaves most of the flap wins, a hidden one first.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from popsim.layout.bench import Bench
from popsim.layout.flap import Flap
from popsim.layout.joints import Joint
from popsim.layout.keep_off import KeepOff
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.placing import Placing
from popsim.layout.settings import LayoutSettings
from popsim.layout.sites import Site
from popsim.layout.teeth import share_edges

CLEARINGS = 4
"""Times that flaps which are in the way are moved or cut."""

ROUNDS = 5
"""Times that flaps are made shallower where no room was left for one."""


FLIMSY = 4.5
"""mm; flaps on shorter stretches hold next to nothing: they are left out where the joint has a longer one."""


InTheWay = Callable[[Mapping[str, Part], tuple[Flap, ...]], tuple[KeepOff, ...]]
"""Told all parts by id and all flaps, names the lines where flaps are in the way and which they must keep off."""


class Task(NamedTuple):
    """One stretch of a glue joint, with the sites that it can choose from."""

    joint: Joint
    stretch: int
    choices: tuple[Site, ...]

    @property
    def freedom(self) -> tuple[int, int]:
        """How much there is to choose from; who has least goes first."""
        return len({site.carrier.id for site in self.choices}), len(self.choices)


def plan_flaps(
    parts: Mapping[str, Part],
    joints: tuple[Joint, ...],
    nets: tuple[Net, ...],
    settings: LayoutSettings,
    in_the_way: InTheWay,
) -> tuple[tuple[Flap, ...], tuple[Joint, ...]]:
    """Return the flaps of all joints that are no folds of `nets`, in their order, and the joints left over.

    Stretches of joints that must share an edge are divided among them. A joint is left over where no flap of use
    fits on any side. Flaps that `in_the_way` objects to are moved or cut as long as all joints keep one.
    """
    joints = share_edges(joints, Bench(parts, joints, nets, settings).carriers())
    bench = Bench(parts, joints, nets, settings)
    tasks = [Task(joint, k, bench.sites(joint, k)) for joint in bench.open for k in _worth_gluing(joint)]
    depths = dict.fromkeys(parts, settings.flap_depth)
    for _ in range(ROUNDS):
        flaps, left = _plan(tasks, Placing(bench, depths, ()))
        if not left:
            return _cleared(tasks, bench, depths, flaps, in_the_way), ()
        # whatever lands where room ran out gets half as deep, to leave some for all
        depths |= {name: depths[name] / 2 for name in sorted({name for joint in left for name in joint.parts})}
    return flaps, left


def _cleared(
    tasks: list[Task], bench: Bench, depths: Mapping[str, float], flaps: tuple[Flap, ...], in_the_way: InTheWay
) -> tuple[Flap, ...]:
    """The flaps with the fewest lines in their way, of some rounds in which they keep off all found before."""
    best, fewest = flaps, in_the_way(bench.parts, flaps)
    keep_off, found = fewest, fewest
    for _ in range(CLEARINGS):
        if not found:
            break
        flaps, left = _plan(tasks, Placing(bench, depths, keep_off))
        if left:
            break
        found = in_the_way(bench.parts, flaps)
        keep_off += found
        if len(found) < len(fewest):
            best, fewest = flaps, found
    return best


def _plan(tasks: list[Task], placing: Placing) -> tuple[tuple[Flap, ...], tuple[Joint, ...]]:
    """One round of planning: flaps by task, who has least to choose from first, and joints without any."""
    found: dict[tuple[str, int], Flap] = {}
    for task in sorted(tasks, key=lambda task: task.freedom):
        flap = placing.place(task.choices)
        if flap is not None:
            found[task.joint.id, task.stretch] = flap
    flaps = tuple(found[key] for task in tasks if (key := (task.joint.id, task.stretch)) in found)
    held = {flap.joint.id for flap in flaps}
    left = {task.joint.id: task.joint for task in tasks if task.joint.id not in held}
    return flaps, tuple(left.values())


def _worth_gluing(joint: Joint) -> list[int]:
    """The stretches of a joint that get a flap."""
    lengths = [float(np.linalg.norm(ends[1] - ends[0])) for ends in joint.stretches]
    return [k for k, length in enumerate(lengths) if length >= min(FLIMSY, max(lengths))]

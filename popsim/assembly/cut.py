"""Where a bundle can come apart: parts that lie on top of all others, and the joints that hold them."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from popsim.assembly.bundle import Bundle
from popsim.assembly.stack import Stack
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import line_distance
from popsim.geometry.rigid import transform
from popsim.layout import Joint, Layout

ONE_LINE = 0.3
"""mm; joints this near to one line turn about it together."""


@dataclass(frozen=True)
class Cut:
    """A way to take a bundle apart, or to open it.

    Attributes
    ----------
    moved:
        Ids of the parts that move.
    taken:
        Ids of the glue joints that are undone.
    line:
        Ids of the joints about whose line `moved` turns; none where it comes off altogether.
    side:
        1 where it moves off the upper side of the stack, -1 off the lower.
    """

    moved: frozenset[str]
    taken: tuple[str, ...]
    line: tuple[str, ...]
    side: int


def cuts(bundle: Bundle, stack: Stack) -> Iterator[Cut]:
    """All cuts that leave both sides in one, each once, in a fixed order."""
    seen: set[Cut] = set()
    for moved, side in _on_top(bundle, stack):
        for line, taken in _releases(bundle, moved):
            cut = Cut(moved, taken, line, side)
            if cut not in seen:
                seen.add(cut)
                yield cut


def ranks(layout: Layout) -> dict[str, int]:
    """What is undone first, by joint id, from 0.

    What holds something to the card; what holds two mechanisms together; what holds one; the card; seams.
    """
    found = {}
    for joint in layout.joints:
        patches = [layout.parts[name].patch for name in joint.parts]
        pages = sum(patch.id in (GROUND_ID, BACKDROP_ID) for patch in patches)
        between = patches[0].mechanism != patches[1].mechanism
        found[joint.id] = 4 if joint.hinge is None else (2 - between, 0, 3)[pages]
    return found


def _on_top(bundle: Bundle, stack: Stack) -> Iterator[tuple[frozenset[str], int]]:
    """Groups of parts on which no others lie, and on which side of the stack they are."""
    for side, above in ((1, stack.over), (-1, stack.under)):
        known: set[frozenset[str]] = set()
        for seed in _seeds(bundle):
            moved = _closure(bundle, seed, above)
            rest = bundle.groups(bundle.parts - moved)
            if len(rest) > 1:
                moved = bundle.parts - max(rest, key=partial(_weight, bundle))
            if not rest or moved in known or len(bundle.groups(moved)) > 1:
                continue
            known.add(moved)
            if moved == _closure(bundle, moved, above):
                yield moved, side


def _weight(bundle: Bundle, parts: frozenset[str]) -> tuple[bool, int]:
    """What has more of it rather stays in its place: the card, else more parts."""
    return bundle.kit.ground(parts) is not None, len(parts)


def _seeds(bundle: Bundle) -> Iterator[frozenset[str]]:
    layout = bundle.kit.layout
    names = [name for name in layout.parts if name in bundle.parts]
    homes = {name: layout.parts[name].patch.mechanism for name in names}
    for home in dict.fromkeys(homes.values()):
        yield frozenset(name for name in names if homes[name] == home)
    for piece in layout.pieces:
        if not bundle.parts.isdisjoint(piece.motions):
            own = bundle.only(piece.motions)
            yield own.parts
            for joint in own.joints:
                sides = own.groups(own.parts, (joint,))
                yield from sides if len(sides) == 2 else ()
    for name in names:
        yield frozenset((name,))


def _closure(bundle: Bundle, seed: frozenset[str], above: dict[str, frozenset[str]]) -> frozenset[str]:
    """The seed with all that lies on it in the same sheet."""
    found, waiting = set[str](), list(seed)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            sheet = bundle.sheets[name]
            waiting += [other for other in above[name] if bundle.sheets.get(other) == sheet]
    return frozenset(found)


def _releases(bundle: Bundle, moved: frozenset[str]) -> Iterator[tuple[tuple[str, ...], tuple[str, ...]]]:
    """The lines about which some parts can be turned, and the joints to be undone for it."""
    crossing = bundle.crossing(moved)
    fixed = {joint.id for joint in crossing if joint.id not in bundle.kit.flaps_of}
    lines = [line for line in _lines(bundle, crossing) if not any(_is_open(bundle, joint) for joint in line)]
    kept = [tuple(joint.id for joint in line) for line in lines]
    for line in ([] if fixed else [()]) + [names for names in kept if fixed <= set(names)]:
        yield line, tuple(joint.id for joint in crossing if joint.id not in line)


def _lines(bundle: Bundle, joints: Iterable[Joint]) -> list[list[Joint]]:
    """Joints that turn, by the lines on which they lie now."""
    found: list[tuple[FloatArray, list[Joint]]] = []
    for joint in joints:
        if joint.hinge is None:
            continue
        ends = axis(bundle, joint)
        near = next((own for line, own in found if line_distance(ends, line).max() < ONE_LINE), None)
        if near is None:
            found.append((ends, [joint]))
        else:
            near.append(joint)
    return [own for _, own in found]


def _is_open(bundle: Bundle, joint: Joint) -> bool:
    """Whether the two parts of a joint were swung apart already."""
    first, second = joint.parts
    return bundle.sheets[first] != bundle.sheets[second]


def axis(bundle: Bundle, joint: Joint) -> FloatArray:
    """Ends of the line of a joint as it lies now, shape (2, 3)."""
    ends = np.concatenate(joint.stretches)
    along = ends @ (ends[-1] - ends[0])
    return transform(bundle.poses[joint.parts[0]], ends[[along.argmin(), along.argmax()]])

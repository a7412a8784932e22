"""Where a bundle can come apart: parts that lie on top of all others, and the joints that hold them."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial, reduce
from operator import or_

from popsim.assembly.bundle import Bundle, Sheet
from popsim.assembly.kit import ONE_LINE
from popsim.assembly.roll import groups, places, spread
from popsim.assembly.stack import Stack
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.geometry.plane import line_distance
from popsim.layout import Joint, Layout


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
    roll = bundle.kit.roll
    whole = roll.mask(bundle.parts)
    seeds = list(dict.fromkeys(_seeds(bundle)))
    for side in (1, -1):
        above = _above(bundle, stack, side)
        piles = [spread(1 << place, above, whole) if whole >> place & 1 else 0 for place in range(len(above))]
        tried: set[int] = set()
        known: set[int] = set()
        for seed in seeds:
            moved = reduce(or_, (piles[place] for place in places(seed)))
            if moved in tried:
                continue
            tried.add(moved)
            rest = groups(whole & ~moved, bundle.near)
            if len(rest) > 1:
                moved = whole & ~max(rest, key=partial(_weight, roll.mask(bundle.kit.grounds)))
            if not rest or moved in known or len(groups(moved, bundle.near)) > 1:
                continue
            known.add(moved)
            if not reduce(or_, (above[place] for place in places(moved))) & ~moved:
                yield roll.names(moved), side


def _above(bundle: Bundle, stack: Stack, side: int) -> list[int]:
    """What lies on each part in the same sheet, as masks."""
    sheets: dict[Sheet, list[str]] = {}
    for name, sheet in bundle.sheets.items():
        sheets.setdefault(sheet, []).append(name)
    found = [0] * len(bundle.kit.layout.parts)
    for names in sheets.values():
        own = bundle.kit.roll.mask(names)
        for place in places(own):
            found[place] = stack.masks[side][place] & own
    return found


def _weight(grounds: int, parts: int) -> tuple[bool, int]:
    """What has more of it rather stays in its place: the card, else more parts; ties go to the first part."""
    return bool(parts & grounds), parts.bit_count()


def _seeds(bundle: Bundle) -> Iterator[int]:
    """What may come off together, as masks: mechanisms, pieces, either side of a joint in one, single parts."""
    layout, roll, whole = bundle.kit.layout, bundle.kit.roll, bundle.kit.roll.mask(bundle.parts)
    homes: dict[str | None, int] = {}
    for name, part in layout.parts.items():
        homes[part.patch.mechanism] = homes.get(part.patch.mechanism, 0) | roll.mask((name,)) & whole
    yield from filter(None, homes.values())
    edges = [roll.mask(joint.parts) for joint in bundle.joints.values()]
    single = [edge for edge, count in Counter(edges).items() if count == 1]
    for piece in layout.pieces:
        own = roll.mask(piece.motions) & whole
        if own:
            yield own
            for edge in single:
                if not edge & ~own:
                    yield from _sides(own, edge, bundle.near)
    for place in places(whole):
        yield 1 << place


def _sides(own: int, edge: int, near: list[int]) -> list[int]:
    """What hangs together on either side of the one joint of two parts, the larger first; none if all does."""
    without = list(near)
    for place in places(edge):
        without[place] &= ~edge
    found = groups(own, without)
    return sorted(found, key=int.bit_count, reverse=True) if len(found) == 2 else []


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
    found: list[list[Joint]] = []
    for joint in joints:
        if joint.hinge is not None:
            line = next((own for own in found if _in_line(bundle, joint, own[0])), None)
            if line is None:
                found.append([joint])
            else:
                line.append(joint)
    return found


def _in_line(bundle: Bundle, joint: Joint, other: Joint) -> bool:
    """Whether two joints lie on one line now; in one sheet they do where they do in the folded pop-up."""
    if bundle.sheets[joint.parts[0]] == bundle.sheets[other.parts[0]]:
        return other.id in bundle.kit.in_line[joint.id]
    return bool(line_distance(bundle.axis(joint), bundle.axis(other)).max() < ONE_LINE)


def _is_open(bundle: Bundle, joint: Joint) -> bool:
    """Whether the two parts of a joint were swung apart already."""
    first, second = joint.parts
    return bundle.sheets[first] != bundle.sheets[second]

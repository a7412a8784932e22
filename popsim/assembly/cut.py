"""Where a bundle can come apart: parts that lie on top of all others, and the joints that hold them."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

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
    seeds = list(dict.fromkeys(roll.mask(seed) for seed in _seeds(bundle)))
    for side in (1, -1):
        above = _above(bundle, stack, side)
        known: set[int] = set()
        for seed in seeds:
            moved = spread(seed, above, whole)
            rest = groups(whole & ~moved, bundle.near)
            if len(rest) > 1:
                moved = whole & ~max(rest, key=partial(_weight, roll.mask(bundle.kit.grounds)))
            if not rest or moved in known or len(groups(moved, bundle.near)) > 1:
                continue
            known.add(moved)
            if moved == spread(moved, above, whole):
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

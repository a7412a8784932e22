"""What to do in a step, in one sentence; the words stand in :mod:`popsim.wording`, the rest is in the picture."""

from collections.abc import Iterable

from popsim import wording
from popsim.assembly.way import Way
from popsim.layout import Face, Flap, Layout
from popsim.wording import counted, listed, sentence

WAYS = {
    Way.LAID: wording.LAID,
    Way.SLID: wording.SLID,
    Way.FOLDED: wording.FOLDED,
    Way.CLOSED: wording.CLOSED,
    Way.TUCKED: wording.TUCKED,
    Way.BROUGHT: wording.BROUGHT,
    Way.HELD: wording.HELD,
}


def cutting_text(layout: Layout) -> str:
    """First step: cut out everything."""
    creases = sum(len(piece.folds) for piece in layout.pieces)
    return wording.CUTTING.format(
        creases=counted(creases, wording.CREASES),
        pieces=counted(len(layout.pieces), wording.PIECES),
        sheets=counted(layout.sheet_count, wording.SHEETS),
    )


def gluing_text(layout: Layout, joints: tuple[str, ...], way: Way, flat: Iterable[str]) -> str:
    """A step that glues joints; what lay open of pieces `flat`, by name, is folded over before."""
    return _told(WAYS[way].format(what=_what(layout, joints)), flat)


def unproved_text(layout: Layout, joints: tuple[str, ...], reason: str, flat: Iterable[str] = ()) -> str:
    """The same where no way was found in simulation."""
    return _told(wording.UNPROVED.format(reason=reason, what=_what(layout, joints)), flat)


def _told(text: str, flat: Iterable[str]) -> str:
    pieces = [wording.PIECE_NAMED.format(name=name) for name in flat]
    return sentence(wording.FLAT_BEFORE.format(pieces=listed(pieces), rest=text) if pieces else text)


def _what(layout: Layout, joints: tuple[str, ...]) -> str:
    """The flaps of joints and where they go."""
    first = {flap.joint.id: flap for flap in reversed(layout.flaps)}
    alike: dict[tuple[str, str, Face, bool], list[Flap]] = {}
    for joint in joints:
        alike.setdefault(_manner(layout, first[joint]), []).append(first[joint])
    if len(alike) > 1:
        return wording.SEVERAL.format(numbers=listed([str(layout.numbers[joint]) for joint in joints]))
    (flaps,) = alike.values()
    return _flaps(layout, flaps)


def _manner(layout: Layout, flap: Flap) -> tuple[str, str, Face, bool]:
    """What flaps have in common that are told together: pieces, face, and whether it is a seam."""
    carrier, target = layout.piece_of[flap.carrier].name, layout.piece_of[flap.target].name
    return carrier, target, flap.face, flap.joint.hinge is None


def _flaps(layout: Layout, flaps: list[Flap]) -> str:
    carrier, target, face, seam = _manner(layout, flaps[0])
    numbers = [str(layout.numbers[flap.joint.id]) for flap in flaps]
    several = len(flaps) > 1
    named = wording.FLAPS[several].format(numbers=listed(numbers), name=carrier)
    if seam:
        return wording.SEAM.format(name=target, flaps=named)
    where = wording.ON_ITSELF if carrier == target else wording.ON.format(name=target)
    if face is Face.REVERSE:
        hidden = [wording.BEHIND_NUMBER.format(number=number) for number in numbers]
        return wording.BEHIND.format(flaps=named, numbers=listed(hidden), where=where)
    return wording.ONTO[several].format(flaps=named, numbers=listed(numbers), where=where)

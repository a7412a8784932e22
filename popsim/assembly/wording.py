"""All sentences of the assembly steps, in one place."""

from collections.abc import Iterable

from popsim.assembly.way import Way
from popsim.layout import Crease, Face, Flap, Layout, Piece


def cutting_text(layout: Layout) -> str:
    """First step: cut out everything."""
    sheets, count = _count(layout.sheet_count, "sheet"), _count(len(layout.pieces), "piece")
    creases = sum(len(piece.folds) for piece in layout.pieces)
    return (
        f"Cut out {count} from {sheets} along the solid lines. Score {_count(creases, 'crease')} with a blunt "
        "knife and a ruler before folding."
    )


def gluing_text(layout: Layout, new: Iterable[str], joints: tuple[str, ...]) -> str:
    """One gluing step: fold what is new, then glue."""
    by_name = {piece.name: piece for piece in layout.pieces}
    sentences = [_fold_text(by_name[name]) for name in new if by_name[name].folds]
    first = {flap.joint.id: flap for flap in reversed(layout.flaps)}
    alike: dict[tuple[str, str, Face, bool], list[Flap]] = {}
    for joint in joints:
        alike.setdefault(_manner(layout, first[joint]), []).append(first[joint])
    sentences += [_glue_text(layout, flaps) for flaps in alike.values()]
    return " ".join(sentences)


def closing_text() -> str:
    """Last step: try it."""
    return "Let the glue dry. Close the card slowly, helping each crease in its direction, and open it again."


WAYS = {
    Way.LAID: "Lay it on from above and press.",
    Way.SLID: "Slide it in, then fold the flaps onto it and press.",
    Way.FOLDED: "Fold it over and press.",
    Way.CLOSED: "Put the glue on with the paper open as shown, then fold all flat along creases and press.",
    Way.TUCKED: "Tuck the flap in between the layers with tweezers and press.",
    Way.BROUGHT: "Put it to its place with the paper open as shown, then fold all flat along creases and press.",
    Way.HELD: "Hold the paper open as shown and press the flaps between two fingers.",
}


def way_text(way: Way) -> str:
    """How what is glued comes together."""
    return WAYS[way]


def folding_text(names: Iterable[str]) -> str:
    """What lay open is folded over first; the picture shows how it lies then."""
    return f"Fold {_listed([f'piece {name}' for name in names])} flat as shown."


def unproved_text(reason: str) -> str:
    """What a step says for which no way was found in simulation."""
    return f"(No way to do this was found in simulation: {reason}. Bend the paper gently.)"


def _fold_text(piece: Piece) -> str:
    mountains = sum(fold.crease is Crease.MOUNTAIN for fold in piece.folds)
    valleys = len(piece.folds) - mountains
    kinds = [f"{n} {kind}" for n, kind in ((mountains, "mountain"), (valleys, "valley")) if n]
    return f"Fold piece {piece.name} along its {_count(len(piece.folds), 'crease')} ({', '.join(kinds)})."


def _manner(layout: Layout, flap: Flap) -> tuple[str, str, Face, bool]:
    """What flaps of one sentence have in common: pieces, face, and whether it is a seam."""
    carrier, target = layout.piece_of[flap.carrier].name, layout.piece_of[flap.target].name
    return carrier, target, flap.face, flap.joint.hinge is None


def _glue_text(layout: Layout, flaps: list[Flap]) -> str:
    carrier, target, face, seam = _manner(layout, flaps[0])
    numbers = [str(layout.numbers[flap.joint.id]) for flap in flaps]
    flap = f"flap{'s' * (len(flaps) > 1)} {_listed(numbers)} of piece {carrier}"
    if seam:
        return f"Lay piece {target} edge to edge over {flap} and glue it."
    where = "of the same piece" if carrier == target else f"on piece {target}"
    if face is Face.REVERSE:
        return f"Glue {flap} behind {_listed([f'({number})' for number in numbers])} {where}."
    return f"Glue {flap} to place{'s' * (len(flaps) > 1)} {_listed(numbers)} {where}."


def _listed(words: list[str]) -> str:
    """1; 1 and 2; 1, 2 and 3."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"

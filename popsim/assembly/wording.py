"""All sentences of the assembly steps, in one place."""

from collections.abc import Iterable

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
    for joint in joints:
        flaps = [flap for flap in layout.flaps if flap.joint.id == joint]
        sentences.append(_glue_text(layout, flaps))
    return " ".join(sentences)


def closing_text() -> str:
    """Last step: try it."""
    return "Let the glue dry. Close the card slowly, helping each crease in its direction, and open it again."


def _fold_text(piece: Piece) -> str:
    mountains = sum(fold.crease is Crease.MOUNTAIN for fold in piece.folds)
    valleys = len(piece.folds) - mountains
    kinds = [f"{n} {kind}" for n, kind in ((mountains, "mountain"), (valleys, "valley")) if n]
    return f"Fold piece {piece.name} along its {_count(len(piece.folds), 'crease')} ({', '.join(kinds)})."


def _glue_text(layout: Layout, flaps: list[Flap]) -> str:
    flap = flaps[0]
    number = layout.numbers[flap.joint.id]
    carrier, target = layout.piece_of[flap.carrier].name, layout.piece_of[flap.target].name
    noun = "flap" if len(flaps) == 1 else f"all {len(flaps)} flaps"
    side = "place" if flap.face is Face.PRINTED else "the back of place"
    where = "of the same piece" if carrier == target else f"on piece {target}"
    if flap.joint.hinge is None:
        return f"Lay piece {target} edge to edge over {noun} {number} of piece {carrier} and glue it."
    return f"Glue {noun} {number} of piece {carrier} to {side} {number} {where}."


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"

"""What every abstraction grows from: the empty card, or what the user keeps on it."""

from popsim.design import Card
from popsim.errors import InputError
from popsim.fitting.candidate import Candidate, Node, build
from popsim.fitting.wishes import Wishes
from popsim.mechanisms import assemble
from popsim.validity import examine


def first_candidate(card: Card, least: float, wishes: Wishes, most_patches: int) -> Candidate:
    """Return the candidate of the kept mechanisms, and of nothing else.

    Raises
    ------
    InputError
        They do not fold, or have more than `most_patches` patches.
    """
    ids: list[str | None] = [mechanism.id for mechanism in wishes.kept]
    nodes = [
        Node(kept.primitive(), kept.pair, None if kept.pair.owner is None else ids.index(kept.pair.owner), kept)
        for kept in wishes.kept
    ]
    start = build(card, nodes, least, wishes)
    if start is None or not nodes:
        return Candidate(card, least=least, wishes=wishes)
    broken = [c for c in examine(assemble(card, start.mechanisms, checked=False)).conditions if not c.holds]
    if broken:
        worst = min(broken, key=lambda condition: condition.margin)
        raise InputError(
            f"what is kept does not fold: {worst.subject} breaks '{worst.name}' by {-worst.margin:.3g} mm; "
            "change its parameters or keep less"
        )
    if start.patches > most_patches:
        raise InputError(
            f"what is kept has {start.patches} patches, more than the {most_patches} allowed; keep less"
        )
    return start

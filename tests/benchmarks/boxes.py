"""Cards of any number of patches: box-folds in a row along the fold."""

from popsim.design import Card, Design
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold

PITCH, LENGTH, HALF_WIDTH, HEIGHT = 50.0, 20.0, 10.0, 15.0
"""mm; closing ranges of neighbours do not overlap."""


def row_of_boxes(patches: int) -> Design:
    """A sound design of at least `patches` patches, pages included."""
    each = len(_row(1).patches) - 2
    return _row(-(-(patches - 2) // each))


def _row(count: int) -> Design:
    card = Card(x=(-LENGTH, count * PITCH), depth=60.0)
    starts = [k * PITCH for k in range(count)]
    pair = card_pair(card)
    return assemble(
        card,
        [BoxFold.plain(f"M{k}", pair, HALF_WIDTH, HEIGHT, (at, at + LENGTH)) for k, at in enumerate(starts)],
    )

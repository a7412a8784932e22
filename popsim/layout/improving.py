"""Changing what is laid out for the sake of the sheets, step by step."""

from collections.abc import Callable, Iterator, Sequence

from popsim.layout.errors import LayoutError
from popsim.layout.laid import Laid, Planned, is_worth
from popsim.layout.nesting import Estimator
from popsim.layout.too_large import Room
from popsim.layout.waste import Waste

PLANS = 4
"""Changes planned in full at most at a time: estimates are not exact."""

Change = Callable[[], Planned]
"""Plans all anew; may raise LayoutError where that leaves no room."""


def improvements(
    laid: Laid,
    changes: Callable[[Laid], Sequence[Change]],
    place: Callable[[Planned], Laid],
    estimator: Estimator,
    room: Room,
    *,
    most: int,
) -> Iterator[Laid]:
    """Yield what is laid out after each change, while sheets but the last are not well filled and one is worth it.

    Parameters
    ----------
    changes:
        Finds what could be changed, the most promising first.
    place:
        Finds places for all pieces.
    most:
        How often something is changed at most.
    """
    for _ in range(most):
        before = laid.waste(room)
        better = _best(before, changes(laid)[:PLANS], place, estimator, room) if before.lacking else None
        if better is None:
            return
        laid = better
        yield laid


def _best(
    before: Waste, changes: Sequence[Change], place: Callable[[Planned], Laid], estimator: Estimator, room: Room
) -> Laid | None:
    """The first change that is worth it and leaves all sheets well filled, else the best that is worth it."""
    best: tuple[Waste, Laid] | None = None
    for change in changes:
        try:
            planned = change()
        except LayoutError:  # its flaps have no room
            continue
        estimate = estimator.waste(planned.outlines)
        if estimate is None or not estimate < before:
            continue
        laid = place(planned)
        after = laid.waste(room)
        if is_worth(after, before) and (best is None or after < best[0]):
            best = after, laid
            if not after.lacking:
                break
    return best[1] if best else None

"""Changing what is laid out for the sake of the sheets, step by step."""

from collections.abc import Callable, Sequence

from popsim.layout.errors import LayoutError
from popsim.layout.laid import Laid, Planned, is_worth
from popsim.layout.nesting import Estimator
from popsim.layout.too_large import Room

PLANS = 4
"""Changes planned in full at most at a time: estimates are not exact."""


def improved(
    laid: Laid,
    changes: Callable[[Laid], Sequence[Callable[[], Planned]]],
    place: Callable[[Planned], Laid],
    estimator: Estimator,
    room: Room,
    *,
    most: int,
) -> Laid:
    """What is laid out, changed while sheets but the last are not well filled and a change is worth it.

    Parameters
    ----------
    changes:
        Finds what could be changed, the most promising first; each plans all anew, and may raise LayoutError where
        that leaves no room.
    place:
        Finds places for all pieces.
    most:
        How often something is changed at most.
    """
    for _ in range(most):
        better = _best_change(laid, changes, place, estimator, room) if laid.waste(room).lacking else None
        if better is None:
            break
        laid = better
    return laid


def _best_change(
    laid: Laid,
    changes: Callable[[Laid], Sequence[Callable[[], Planned]]],
    place: Callable[[Planned], Laid],
    estimator: Estimator,
    room: Room,
) -> Laid | None:
    """The first change that is worth it and leaves all sheets well filled, else the best that is worth it."""
    before, best = laid.waste(room), None
    for change in changes(laid)[:PLANS]:
        try:
            planned = change()
        except LayoutError:  # its flaps have no room
            continue
        after = estimator.waste(planned.outlines)
        if after is None or not after < before:
            continue
        other = place(planned)
        if is_worth(other.waste(room), before) and (best is None or other.waste(room) < best.waste(room)):
            best = other
        if best is not None and not best.waste(room).lacking:
            break
    return best

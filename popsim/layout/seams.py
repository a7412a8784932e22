"""Choosing where patches are divided with all sheets in view.

The plainest seams are short and cross no hinge. Where they seem to leave sheets badly filled, others are sketched,
plane by plane, until none is estimated to waste less: first those that make as many parts, and then, if sheets are
still not well filled, those that make one more of a patch, or one more row of them. What is best is planned in
full.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property

from popsim.layout.divisions import Division, count_parts
from popsim.layout.errors import LayoutError
from popsim.layout.laid import Laid, Planned, is_worth
from popsim.layout.nesting import Estimator, suffices
from popsim.layout.settings import LayoutSettings
from popsim.layout.sketch import Sketch
from popsim.layout.too_large import Room
from popsim.layout.waste import Waste

SWEEPS = 2
"""Times that each plane is looked at."""

EFFORT = 50_000_000
"""Cells looked at after which no more seams are sketched; twice as many where one part more is tried."""

FURTHER = 4
"""Sketches beside the best that are planned in full at most, while sheets are not well filled."""


def lay_out_divided(
    plan: Callable[[Sequence[Division]], Planned],
    place: Callable[[Planned], Laid],
    plain: Sequence[Division],
    others: Callable[[], Sequence[Sequence[Division]]],
    estimator: Estimator,
    room: Room,
    settings: LayoutSettings,
    enough: Callable[[], bool] = lambda: False,
) -> Iterator[Laid]:
    """Yield what is laid out with the plainest seams, and then with others, if those are worth it.

    Estimates are not exact: where sheets are still not well filled, what seems next best is planned in full too.

    Parameters
    ----------
    plan:
        Plans all pieces for one division of each plane; may raise LayoutError.
    place:
        Finds places for all pieces.
    plain:
        The plainest division of each plane.
    others:
        Finds other divisions of each plane.
    enough:
        Asked whether what was made of all that was yielded fills its sheets well.
    """
    seams = _Seams(plain, others)
    plain, planned = _first(plan, seams)
    laid = place(planned)
    yield laid
    before = laid.waste(room)
    if not plain or suffices(before, planned.shares(room)):
        return
    sketched = _sketched(Sketch(planned, settings.seam_depth), plain, seams, estimator)
    for k, chosen in enumerate(sketched[: 1 + FURTHER]):
        if k and (not before.lacking or enough()):
            return
        if _same(chosen, plain):
            continue
        try:
            found = place(plan(chosen))
        except LayoutError:  # its flaps have no room
            continue
        if is_worth(found.waste(room), before):
            before = found.waste(room)
            yield found


class _Seams:
    """The plainest divisions of all planes, and others once they are asked for."""

    def __init__(self, plain: Sequence[Division], others: Callable[[], Sequence[Sequence[Division]]]) -> None:
        self.plain = plain
        self._others = others

    @cached_property
    def ways(self) -> list[list[Division]]:
        """All divisions of each plane, the plainest first."""
        return [[plain, *others] for plain, others in zip(self.plain, self._others(), strict=True)]

    def in_turn(self) -> Iterator[Sequence[Division]]:
        """The plainest divisions, then others."""
        yield self.plain
        if not self.plain:
            return
        for k in range(1, max(map(len, self.ways))):
            yield [own[min(k, len(own) - 1)] for own in self.ways]

    def ways_of(self, *, more: bool) -> list[list[Division]]:
        """Divisions of each plane into as many parts as the plainest makes at most; all of them, if `more`."""
        return [[d for d in own if more or count_parts(d) <= count_parts(own[0])] for own in self.ways]


def _first(plan: Callable[[Sequence[Division]], Planned], seams: _Seams) -> tuple[Sequence[Division], Planned]:
    """The plainest divisions that leave room for all flaps, and what is planned with them."""
    refusal: LayoutError | None = None
    for divisions in seams.in_turn():
        try:
            return divisions, plan(divisions)
        except LayoutError as error:
            refusal = refusal or error
    raise refusal or LayoutError("nothing can be laid out")


def _sketched(
    sketch: Sketch, plain: Sequence[Division], seams: _Seams, estimator: Estimator
) -> list[Sequence[Division]]:
    """The divisions that are estimated to waste least, and then all that were sketched, the best first.

    One plane after the other is divided anew.
    """
    known: list[tuple[Waste, Sequence[Division]]] = []

    def waste(divisions: Sequence[Division]) -> Waste | None:
        found = estimator.waste(sketch.shapes({name: own for each in divisions for name, own in each.items()}))
        if found is not None and not any(_same(divisions, other) for _, other in known):
            known.append((found, divisions))
        return found

    def ranked() -> list[Sequence[Division]]:
        others = sorted(known, key=lambda one: one[0])
        return [chosen, *(divisions for _, divisions in others if not _same(divisions, chosen))]

    chosen, least, start = list(plain), waste(plain), estimator.effort
    for more in (0, 1):
        if more and (least is None or not least.lacking):
            break
        for _ in range(SWEEPS):
            before = chosen
            for k, divisions in enumerate(seams.ways_of(more=bool(more))):
                for division in divisions:
                    if estimator.effort - start > EFFORT * (1 + more):
                        return ranked()
                    tried = [*chosen[:k], division, *chosen[k + 1 :]]
                    found = waste(tried)
                    if found is not None and (least is None or _is_better(tried[k], found, chosen[k], least)):
                        chosen, least = tried, found
            if _same(chosen, before):
                break
    return ranked()


def _is_better(tried: Division, found: Waste, chosen: Division, least: Waste) -> bool:
    """Whether a division wastes less than the one chosen so far; much less, where it makes more parts."""
    return is_worth(found, least) if count_parts(tried) > count_parts(chosen) else found < least


def _same(one: Sequence[Division], other: Sequence[Division]) -> bool:
    return all(a is b for a, b in zip(one, other, strict=True))

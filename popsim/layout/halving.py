"""Dividing what would go onto a sheet as it is, for the sake of the sheets.

A ring or a disc nearly as wide as the sheet shares it with nothing, whatever way it is laid; its halves do. Where
sheets but the last are not well filled and no fold helps whose opening would, those parts are divided whose
dividing saves a sheet or fills them, with flaps under their seams. Ground and backdrop carry all: they stay whole.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from popsim.design import BACKDROP_ID, GROUND_ID, Design
from popsim.layout.divisions import Division, hints_of, parts_of
from popsim.layout.improving import Change, improvements
from popsim.layout.laid import Laid, Plan, Planned, is_worth
from popsim.layout.nesting import Estimator
from popsim.layout.settings import LayoutSettings
from popsim.layout.sketch import Sketch
from popsim.layout.split import halved
from popsim.layout.too_large import Room

if TYPE_CHECKING:
    from shapely.geometry import Polygon

    from popsim.layout.parts import Part

HALVED = 4
"""Parts divided at a time at most; each is one more line to glue."""

ROUNDS = 2
"""Times that dividing is planned in full and looked at anew at most."""

WIDE = 0.15
"""Share of a sheet that the hull of a part takes at least that is worth dividing."""

LEANINGS = (0.5, 0.25, 0.75)
"""Where seams are tried, of the range of their places."""

EFFORT = 50_000_000
"""Cells looked at after which no more are sketched."""

Halves = tuple["Polygon", "Polygon"]
"""What a part is divided into, in the flat coordinates of its patch."""


def with_halved_parts(
    plan: Plan,
    place: Callable[[Planned], Laid],
    laid: Laid,
    design: Design,
    estimator: Estimator,
    room: Room,
    settings: LayoutSettings,
) -> Laid:
    """Return what is laid out, or with those parts divided that are worth it.

    That is where sheets are saved, or all but the last are well filled in the end.

    Parameters
    ----------
    plan, place:
        Plan all pieces, and find places for them.
    laid:
        What is laid out without dividing any that need not be.
    """

    def changes(laid: Laid) -> list[Change]:
        found = _promising(laid, design, estimator, room, settings)
        return [partial(plan, (division,), laid.planned.barred) for division in found]

    kept = laid
    for better in improvements(laid, changes, place, estimator, room, most=ROUNDS):
        after = better.waste(room)
        if after.sheets < kept.waste(room).sheets or not after.lacking:
            kept = better
    return kept


def _promising(
    laid: Laid, design: Design, estimator: Estimator, room: Room, settings: LayoutSettings
) -> list[Division]:
    """Divisions that are estimated to be worth it: fewest sheets first, then best filled, then fewest seams.

    One part more is divided at a time, that which seems to leave least waste: often only two together save
    anything.
    """
    before, planned, start = laid.waste(room), laid.planned, estimator.effort
    parts = {part.id: part for part in parts_of(design, planned.divisions, settings.grain_axis(room))}
    ways = {part.id: list(_halvings(part, design)) for part in _wide(laid, parts, room)}
    found: list[tuple[int, float, int, Division]] = []
    chosen: Mapping[str, Halves] = {}
    for count in range(1, min(HALVED, len(ways)) + 1):
        tried = []
        for further in _further(chosen, ways):
            if estimator.effort - start > EFFORT:
                break
            division = _division(parts, further)
            sketch = Sketch(planned, settings.seam_depth, too=further.keys())
            after = estimator.waste(sketch.shapes(division))
            if after is not None:
                tried.append((after, further))
                if is_worth(after, before):
                    found.append((after.sheets, after.lacking, count, division))
        if not tried:
            break
        chosen = min(tried, key=lambda one: one[0])[1]
    return [division for *_, division in sorted(found, key=lambda one: one[:3])]


def _further(chosen: Mapping[str, Halves], ways: Mapping[str, list[Halves]]) -> Iterator[Mapping[str, Halves]]:
    """What is divided, and one part more."""
    for name, own in ways.items():
        if name not in chosen:
            yield from ({**chosen, name: halves} for halves in own)


def _division(parts: Mapping[str, "Part"], halves: Mapping[str, Halves]) -> Division:
    """How all patches are divided with some parts halved, by part id; what stays whole is not in it."""
    found: dict[str, list[Polygon]] = {}
    for name, part in parts.items():
        found.setdefault(part.patch.id, []).extend(halves.get(name, (part.polygon,)))
    return {patch: tuple(own) for patch, own in found.items() if len(own) > 1}


def _wide(laid: Laid, parts: Mapping[str, "Part"], room: Room) -> Iterator["Part"]:
    """Those parts on sheets that are not well filled that are wide, but for ground and backdrop."""
    emptiest = laid.waste(room).emptiest
    for net, spot in zip(laid.planned.nets, laid.places, strict=True):
        for part in (parts[name] for name in net.motions if spot.sheet in emptiest):
            bears = part.patch.id in (GROUND_ID, BACKDROP_ID)
            if not bears and part.polygon.convex_hull.area > WIDE * room[0] * room[1]:
                yield part


def _halvings(part: "Part", design: Design) -> Iterator[Halves]:
    """A part divided across either axis, here and there."""
    hints = hints_of(part, design)
    for leaning in LEANINGS:
        for axis in (0, 1):
            halves = halved(part.polygon, axis, hints, leaning)
            if len(halves) == 2:
                yield halves[0], halves[1]

"""Opening folds for the sake of sheets.

A piece that is large for its sheet leaves much of it empty. Where sheets but the last are not well filled, the
fold whose opening saves a sheet, or fills them, becomes a glue joint; where none does, pieces stay as they are.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from popsim.layout.improving import Change, improvements
from popsim.layout.joints import Joint
from popsim.layout.laid import Laid, Plan, Planned, is_worth
from popsim.layout.nesting import Estimator
from popsim.layout.settings import LayoutSettings
from popsim.layout.too_large import Room
from popsim.layout.waste import Waste

if TYPE_CHECKING:
    from shapely.geometry import Polygon

OPENINGS = 2
"""Folds opened at most; each is one more line to glue."""

EFFORT = 50_000_000
"""Cells looked at after which no folds of sheets that are well filled are tried."""


class Opening(NamedTuple):
    """What a net falls into where one fold is opened.

    Attributes
    ----------
    fold:
        Id of the fold.
    length:
        Of the fold, mm.
    barred:
        Ids of all joints across which a half would else grow together with something, the fold's among them.
    halves:
        Outlines of both, one with a flap.
    """

    fold: str
    length: float
    barred: frozenset[str]
    halves: tuple["Polygon", "Polygon"]


def with_opened_folds(
    plan: Plan,
    place: Callable[[Planned], Laid],
    laid: Laid,
    estimator: Estimator,
    room: Room,
    settings: LayoutSettings,
) -> Laid:
    """Return what is planned on its sheets, or with those folds opened that are worth it.

    Parameters
    ----------
    plan:
        Plans all pieces where joints of some ids are no folds; may raise LayoutError where that leaves no room.
    place:
        Finds places for all pieces.
    laid:
        What is laid out without opening any.
    """

    def changes(laid: Laid) -> list[Change]:
        now = laid.planned
        openings = _promising(laid, estimator, room, settings)
        return [partial(plan, now.divisions, now.barred | opening.barred) for opening in openings]

    *_, last = laid, *improvements(laid, changes, place, estimator, room, most=OPENINGS)
    return last


def _promising(laid: Laid, estimator: Estimator, room: Room, settings: LayoutSettings) -> list[Opening]:
    """Openings that are estimated to be worth it, that which wastes least first.

    What lies on sheets that are well filled is looked at only where nothing of the others helps.
    """
    before, outlines = laid.waste(room), laid.planned.outlines
    start = estimator.effort
    for near in (True, False):
        found: list[tuple[Waste, float, str, Opening]] = []
        for k, place in enumerate(laid.places):
            if (place.sheet in before.emptiest) != near or (not near and estimator.effort - start > EFFORT):
                continue
            for opening in _openings(laid.planned, k, settings.flap_depth):
                after = estimator.waste([*outlines[:k], *outlines[k + 1 :], *opening.halves])
                if after is not None and is_worth(after, before):
                    found.append((after, opening.length, opening.fold, opening))
        if found:
            break
    return [opening for *_, opening in sorted(found, key=lambda one: one[:3])]


def _openings(planned: Planned, index: int, flap_depth: float) -> Iterator[Opening]:
    """Each fold that holds a net together, by the index of the net; flaps are as deep as told, mm."""
    import networkx
    import shapely

    net, piece = planned.nets[index], planned.pieces[index]
    graph = networkx.Graph(fold.parts for fold in net.folds)
    bridges = {frozenset(pair) for pair in networkx.bridges(graph)}
    for fold in piece.folds:
        ends = frozenset(fold.joint.parts)
        if fold.joint not in net.folds or ends not in bridges:
            continue
        rest = networkx.restricted_view(graph, [], [fold.joint.parts])
        first, second = (networkx.node_connected_component(rest, name) for name in fold.joint.parts)
        flap = shapely.LineString(fold.ends).buffer(flap_depth, cap_style="flat")
        halves = planned.together(index, first).union(flap), planned.together(index, second)
        barred = frozenset(joint.id for joint in planned.joints if _leaves(joint, first) or _leaves(joint, second))
        if halves[0].geom_type == halves[1].geom_type == "Polygon":
            yield Opening(fold.joint.id, fold.joint.length, barred, halves)


def _leaves(joint: Joint, members: set[str]) -> bool:
    """Whether one of the two parts of a joint is among some, and the other is not."""
    one, other = joint.parts
    return (one in members) != (other in members)

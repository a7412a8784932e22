"""Opening folds for the sake of sheets.

A piece that is large for its sheet leaves much of it empty. Where sheets but the last are not well filled, the
fold whose opening saves a sheet, or fills them, becomes a glue joint; where none does, pieces stay as they are.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from popsim.geometry.flat import move_shape
from popsim.layout.errors import LayoutError
from popsim.layout.laid import Laid, Planned, is_worth
from popsim.layout.nesting import Estimator
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.pieces import Piece
from popsim.layout.settings import LayoutSettings
from popsim.layout.too_large import Room
from popsim.layout.waste import Waste

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

OPENINGS = 2
"""Folds opened at most; each is one more line to glue."""

PLANS = 2
"""Openings planned in full at most before one is found that is worth it: nets may close elsewhere instead."""


def with_opened_folds(
    plan: Callable[[frozenset[str]], Planned],
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
    barred: frozenset[str] = frozenset()
    for _ in range(OPENINGS):
        before = laid.waste(room)
        folds = _promising(laid, estimator, room, settings) if before.lacking else []
        for fold in folds[:PLANS]:
            try:
                other = plan(barred | {fold})
            except LayoutError:  # its flaps have no room
                continue
            after = estimator.waste(other.outlines)
            if after is None or not is_worth(after, before):
                continue
            opened = place(other)
            if is_worth(opened.waste(room), before):
                barred, laid = barred | {fold}, opened
                break
        else:
            break
    return laid


def _promising(laid: Laid, estimator: Estimator, room: Room, settings: LayoutSettings) -> list[str]:
    """Ids of the folds whose opening is estimated to be worth it, that which wastes least first."""
    before, planned = laid.waste(room), laid.planned
    outlines = planned.outlines
    found: list[tuple[Waste, float, str]] = []
    for k, net in enumerate(planned.nets):
        if laid.places[k].sheet not in before.emptiest:
            continue
        for fold, length, halves in _halves(net, planned.pieces[k], planned.parts, settings.flap_depth):
            after = estimator.waste([*outlines[:k], *outlines[k + 1 :], *halves])
            if after is not None and is_worth(after, before):
                found.append((after, length, fold))
    return [fold for _, _, fold in sorted(found)]


def _halves(
    net: Net, piece: Piece, parts: Mapping[str, Part], flap_depth: float
) -> Iterator[tuple[str, float, list["Polygon"]]]:
    """Each fold that holds a net together: its id, its length, and what it holds, one half with a flap."""
    import networkx
    import shapely

    graph = networkx.Graph(fold.parts for fold in net.folds)
    bridges = {frozenset(pair) for pair in networkx.bridges(graph)}
    for fold in piece.folds:
        ends = frozenset(fold.joint.parts)
        if fold.joint not in net.folds or ends not in bridges:
            continue
        rest = networkx.restricted_view(graph, [], [fold.joint.parts])
        halves: list[BaseGeometry] = []
        for name in fold.joint.parts:
            members = networkx.node_connected_component(rest, name)
            own = [move_shape(net.motions[part], parts[part].polygon) for part in members]
            own += [move_shape(net.motions[f.carrier], f.polygon) for f in piece.flaps if f.carrier in members]
            halves.append(shapely.unary_union([shape.buffer(0.01) for shape in own]))
        flap = shapely.LineString(fold.ends).buffer(flap_depth, cap_style="flat")
        halves[0] = halves[0].union(flap)
        if all(half.geom_type == "Polygon" for half in halves):
            yield fold.joint.id, fold.joint.length, halves

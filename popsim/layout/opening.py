"""Opening folds for the sake of sheets.

A piece that is large for its sheet leaves much of it empty. Where sheets but the last are not well filled, the
fold whose opening saves a sheet, or fills them, becomes a glue joint; where none does, pieces stay as they are.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from popsim.geometry.flat import move_shape
from popsim.layout.errors import LayoutError
from popsim.layout.filling import Place
from popsim.layout.flap import Flap
from popsim.layout.nesting import estimate
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.pieces import Piece
from popsim.layout.settings import LayoutSettings
from popsim.layout.waste import Waste, waste_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

OPENINGS = 2
"""Folds opened at most; each is one more line to glue."""

PLANS = 4
"""Openings planned in full at most before one is found that is worth it: nets may close elsewhere instead."""

GAIN = 0.05
"""Share of a sheet that an opening must fill, unless it saves one."""


@dataclass(frozen=True, eq=False)
class Laid:
    """Nets with their flaps, the pieces made of both, and where they lie; all in the order of the nets."""

    nets: tuple[Net, ...]
    flaps: tuple[Flap, ...]
    pieces: tuple[Piece, ...]
    places: tuple[Place, ...]

    def waste(self, room: tuple[float, float]) -> Waste:
        """What the sheets waste."""
        area = room[0] * room[1]
        return waste_of(
            [piece.outline.area / area for piece in self.pieces], [place.sheet for place in self.places]
        )


def with_opened_folds(
    plan: Callable[[frozenset[str]], Laid],
    parts: Mapping[str, Part],
    room: tuple[float, float],
    settings: LayoutSettings,
) -> Laid:
    """Return what is planned without opening any fold, or with those opened that are worth it.

    Parameters
    ----------
    plan:
        Plans everything where joints of some ids are no folds; may raise LayoutError where that leaves no room.
    """
    barred: frozenset[str] = frozenset()
    laid = plan(barred)
    for _ in range(OPENINGS):
        before = laid.waste(room)
        folds = _promising(laid, parts, room, settings) if before.lacking else []
        for fold in folds[:PLANS]:
            try:
                opened = plan(barred | {fold})
            except LayoutError:  # its flaps have no room
                continue
            if _worth(opened.waste(room), before):
                barred, laid = barred | {fold}, opened
                break
        else:
            break
    return laid


def _worth(after: Waste, before: Waste) -> bool:
    return after.sheets < before.sheets or (
        after.sheets == before.sheets and after.lacking < max(before.lacking - GAIN, 1e-9)
    )


def _promising(
    laid: Laid, parts: Mapping[str, Part], room: tuple[float, float], settings: LayoutSettings
) -> list[str]:
    """Ids of the folds whose opening is estimated to be worth it, that which wastes least first."""
    before = laid.waste(room)
    outlines = [piece.outline for piece in laid.pieces]
    found: list[tuple[Waste, float, str]] = []
    for k, net in enumerate(laid.nets):
        if laid.places[k].sheet not in before.emptiest:
            continue
        for fold, length, halves in _halves(net, laid.pieces[k], parts, settings.flap_depth):
            shapes = [*outlines[:k], *outlines[k + 1 :], *halves]
            after = estimate(shapes, room, settings.apart, settings.grain)
            if after is not None and _worth(after, before):
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

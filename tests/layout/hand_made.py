"""Cards with upright walls made by hand, and how full the sheets of layouts are."""

from collections.abc import Iterable

import numpy as np

from popsim.design import Card, Design, Hinge, Patch
from popsim.design.model import Point
from popsim.design.rules import check_rules
from popsim.layout import Layout
from popsim.layout.waste import taken_of


def wall(
    name: str, y: float, half: float, high: float, holes: tuple[tuple[Point, ...], ...] = ()
) -> tuple[Patch, Hinge]:
    """An upright rectangle that is glued to the ground."""
    foot = ((-half, y, 0.0), (half, y, 0.0))
    patch = Patch(id=name, outline=(*foot, (half, y, high), (-half, y, high)), holes=holes)
    return patch, Hinge(id=f"h-{name}", patches=("G", name), axis=foot, kind="glue")


def card_with(walls: Iterable[tuple[Patch, Hinge]], half: float, deep: float) -> Design:
    """A card, 2 * `half` long, with walls on it."""
    walls = tuple(walls)
    axis = ((-half, 0.0, 0.0), (half, 0.0, 0.0))
    central = Hinge(id="h0", patches=("G", "B"), axis=axis, kind="central", crease=(0.0, 0.0, -1.0))
    design = Design(
        card=Card(x=(-half, half), depth=deep),
        patches=(_page("G", half, 0, deep), _page("B", half, -deep, 0), *(patch for patch, _ in walls)),
        hinges=(central, *(hinge for _, hinge in walls)),
    )
    check_rules(design)
    return design


def _page(name: str, half: float, low: float, high: float) -> Patch:
    return Patch(id=name, outline=((-half, low, 0), (half, low, 0), (half, high, 0), (-half, high, 0)))


def shares(layout: Layout) -> np.ndarray:
    """How full each sheet is, 0 to 1."""
    area = np.prod(layout.settings.area(layout.paper))
    taken = [placement.piece.outline.area / area for placement in layout.placements]
    return taken_of(taken, [placement.sheet for placement in layout.placements])

"""A layout on its way: pieces as planned, and then their places."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from popsim.layout.filling import Place
from popsim.layout.flap import Flap
from popsim.layout.joints import Joint
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.pieces import Piece
from popsim.layout.too_large import Room
from popsim.layout.waste import Waste, waste_of

if TYPE_CHECKING:
    from shapely.geometry import Polygon

GAIN = 0.05
"""Share of a sheet that a change must fill, unless it saves one or fills all."""


@dataclass(frozen=True, eq=False)
class Planned:
    """Parts by id, and joints; nets, their flaps, and the pieces made of both, in the order of the nets."""

    parts: Mapping[str, Part]
    joints: tuple[Joint, ...]
    nets: tuple[Net, ...]
    flaps: tuple[Flap, ...]
    pieces: tuple[Piece, ...]

    @property
    def outlines(self) -> list["Polygon"]:
        """What is cut round, of each piece."""
        return [piece.outline for piece in self.pieces]

    def shares(self, room: Room) -> list[float]:
        """Of a sheet that each piece takes."""
        return [shape.area / (room[0] * room[1]) for shape in self.outlines]


@dataclass(frozen=True, eq=False)
class Laid:
    """What is planned, and where its pieces lie, in their order."""

    planned: Planned
    places: tuple[Place, ...]

    def waste(self, room: Room) -> Waste:
        """What the sheets waste."""
        return waste_of(self.planned.shares(room), [place.sheet for place in self.places])


def is_worth(after: Waste, before: Waste) -> bool:
    """Whether a change that costs something saves a sheet, or fills sheets that are not well filled."""
    return after.sheets < before.sheets or (
        after.sheets == before.sheets and after.lacking < max(before.lacking - GAIN, 1e-9)
    )

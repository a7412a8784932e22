"""A layout on its way: pieces as planned, and then their places."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from popsim.geometry.flat import move_shape
from popsim.layout.divisions import Division
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
    from shapely.geometry.base import BaseGeometry

WELD = 0.01
"""mm; shapes that meet along creases are grown by this to be one."""

GAIN = 0.05
"""Share of a sheet that a change must fill, unless it saves one or fills all."""


@dataclass(frozen=True, eq=False)
class Planned:
    """What is cut, folded and glued, but not yet where it lies.

    Attributes
    ----------
    parts, joints, nets, flaps, pieces:
        Parts by id, and joints; nets, their flaps, and the pieces made of both, in the order of the nets.
    divisions:
        Of patches, as far as they are divided.
    barred:
        Ids of joints that were not allowed to be folds.
    """

    parts: Mapping[str, Part]
    joints: tuple[Joint, ...]
    nets: tuple[Net, ...]
    flaps: tuple[Flap, ...]
    pieces: tuple[Piece, ...]
    divisions: tuple[Division, ...] = ()
    barred: frozenset[str] = frozenset()

    @property
    def outlines(self) -> list["Polygon"]:
        """What is cut round, of each piece."""
        return [piece.outline for piece in self.pieces]

    def shares(self, room: Room) -> list[float]:
        """Of a sheet that each piece takes."""
        return [shape.area / (room[0] * room[1]) for shape in self.outlines]

    def together(self, index: int, members: Collection[str]) -> "BaseGeometry":
        """Some parts of a net and the flaps that they carry in one, in the net's coordinates."""
        import shapely

        net, piece = self.nets[index], self.pieces[index]
        own = [move_shape(net.motions[part], self.parts[part].polygon) for part in net.motions if part in members]
        own += [move_shape(net.motions[f.carrier], f.polygon) for f in piece.flaps if f.carrier in members]
        return shapely.unary_union([shape.buffer(WELD) for shape in own])


@dataclass(frozen=True, eq=False)
class Laid:
    """What is planned, and where its pieces lie, in their order."""

    planned: Planned
    places: tuple[Place, ...]

    def waste(self, room: Room) -> Waste:
        """What the sheets waste."""
        return waste_of(self.planned.shares(room), [place.sheet for place in self.places])


Plan = Callable[[Sequence[Division], frozenset[str]], Planned]
"""Plans all pieces with patches divided as told, where joints of some ids are no folds; may raise LayoutError."""


def is_worth(after: Waste, before: Waste) -> bool:
    """Whether a change that costs something saves a sheet, or fills sheets that are not well filled."""
    return after.sheets < before.sheets or (
        after.sheets == before.sheets and after.lacking < max(before.lacking - GAIN, 1e-9)
    )

"""A layout: all pieces of a design, and where they lie on the sheets."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import flat_motion
from popsim.layout.flap import Flap
from popsim.layout.flaps import InTheWay
from popsim.layout.joints import Joint, find_joints
from popsim.layout.nesting import nest
from popsim.layout.opening import Laid, with_opened_folds
from popsim.layout.paper import Paper, find_paper
from popsim.layout.parts import Part
from popsim.layout.pieces import Piece, make_pieces
from popsim.layout.planning import plan_pieces
from popsim.layout.settings import LayoutSettings
from popsim.layout.split import divide
from popsim.layout.thickness import cut_back


@dataclass(frozen=True, eq=False)
class Placement:
    """A piece on a sheet: index of the sheet and the flat motion (3, 3) from piece to sheet coordinates.

    Sheet coordinates are mm from the lower left corner of the paper, y up.
    """

    piece: Piece
    sheet: int
    motion: FloatArray


@dataclass(frozen=True, eq=False)
class Layout:
    """What is cut, folded and glued.

    Attributes
    ----------
    paper, settings:
        What it was made for.
    parts, joints:
        The rigid bits of paper, by id, and all lines where they meet.
    pieces:
        What is cut, in the order of the design.
    numbers:
        Number printed at both sides of each glue joint, by joint id.
    placements:
        Where the pieces lie, in their order.
    """

    paper: Paper
    settings: LayoutSettings
    parts: Mapping[str, Part]
    joints: tuple[Joint, ...]
    pieces: tuple[Piece, ...]
    numbers: Mapping[str, int]
    placements: tuple[Placement, ...] = field(default=())

    @property
    def sheet_count(self) -> int:
        """Number of sheets."""
        return max((placement.sheet for placement in self.placements), default=-1) + 1

    @property
    def flaps(self) -> tuple[Flap, ...]:
        """All flaps, piece by piece."""
        return tuple(flap for piece in self.pieces for flap in piece.flaps)

    @property
    def piece_of(self) -> dict[str, Piece]:
        """The piece that holds each part, by part id."""
        return {part: piece for piece in self.pieces for part in piece.motions}


def lay_out(
    design: Design,
    *,
    paper: str | Paper = "A4",
    settings: LayoutSettings | None = None,
    in_the_way: InTheWay = lambda parts, flaps: (),
) -> Layout:
    """Lay a design out on sheets of paper (Sec. 4.4): pieces, flaps, places.

    Parameters
    ----------
    design:
        Only its patches, hinges and textures are read.
    paper:
        A format or its name.
    settings:
        Sizes and choices; None for the usual ones.
    in_the_way:
        Asked where flaps would be in the way, so that they are moved or cut; by default they never are.

    Raises
    ------
    LayoutError
        The paper is unknown, or the design does not go onto it; the message states the scale that would fit.
    """
    settings = settings or LayoutSettings()
    paper = paper if isinstance(paper, Paper) else find_paper(paper)
    room = settings.area(paper)
    listed = cut_back(divide(design, paper, settings), design, settings.stock.thickness if settings.stock else 0.0)
    parts = {part.id: part for part in listed}
    joints = find_joints(design, listed)

    def plan(barred: frozenset[str]) -> Laid:
        nets, flaps = plan_pieces(listed, joints, room, settings, in_the_way, barred)
        pieces = make_pieces(parts, nets, flaps)
        shapes, names = [piece.outline for piece in pieces], [piece.name for piece in pieces]
        return Laid(nets, flaps, pieces, tuple(nest(shapes, names, room, settings.apart, settings.grain)))

    laid = with_opened_folds(plan, parts, room, settings)
    corner = flat_motion(0.0, settings.corner(paper))
    placements = tuple(
        Placement(piece, place.sheet, corner @ place.motion)
        for piece, place in zip(laid.pieces, laid.places, strict=True)
    )
    return Layout(paper, settings, parts, joints, laid.pieces, _numbers(joints, laid.flaps), placements)


def _numbers(joints: tuple[Joint, ...], flaps: tuple[Flap, ...]) -> dict[str, int]:
    glued = {flap.joint.id for flap in flaps}
    return {joint.id: k for k, joint in enumerate((j for j in joints if j.id in glued), 1)}

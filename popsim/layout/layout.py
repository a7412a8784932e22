"""A layout: all pieces of a design, and where they lie on the sheets."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import flat_motion, move_shape
from popsim.layout.divisions import Division, other_divisions, parts_of, plain_divisions
from popsim.layout.flap import Flap
from popsim.layout.flaps import InTheWay
from popsim.layout.halving import with_halved_parts
from popsim.layout.joints import Joint, find_joints
from popsim.layout.laid import Laid, Plan, Planned, is_worth
from popsim.layout.nesting import Estimator, nest, suffices
from popsim.layout.opening import with_opened_folds
from popsim.layout.paper import Paper, find_paper
from popsim.layout.parts import Part
from popsim.layout.pieces import Piece, make_pieces
from popsim.layout.planning import plan_pieces
from popsim.layout.recurring import Recurring
from popsim.layout.seams import lay_out_divided
from popsim.layout.settings import LayoutSettings
from popsim.layout.thickness import cut_back
from popsim.layout.too_large import Room, fits, too_large

PATIENCE = (3, 40)
"""Times as many orders are tried where sheets are not well filled, before patches are divided and after."""

ROUNDING = 1e-9
"""mm; what exceeds a sheet by less does not."""


class Placer(Protocol):
    """Finds places for all pieces."""

    def __call__(self, planned: Planned, patience: int = 1) -> Laid: ...


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
    def divided(self) -> dict[str, int]:
        """Into how many parts patches are divided, by patch id; those that are whole are not in it."""
        counts = Counter(part.patch.id for part in self.parts.values())
        return {patch: count for patch, count in counts.items() if count > 1}

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
    room, recurring = settings.area(paper), Recurring()

    def plan(divisions: Sequence[Division], barred: frozenset[str]) -> Planned:
        return _planned(design, tuple(divisions), room, settings, in_the_way, barred, recurring)

    def place(planned: Planned, patience: int = 1) -> Laid:
        names = [piece.name for piece in planned.pieces]
        places = nest(planned.outlines, names, room, settings.apart, settings.grain, patience=patience)
        return Laid(planned, tuple(places))

    estimator = Estimator(room, settings.apart, settings.grain)
    best = _placed_patiently(_undivided(design, plan, place, estimator, room, settings), place, room, PATIENCE[0])
    if settings.split and best.waste(room).lacking:
        halved = with_halved_parts(plan, place, best, design, estimator, room, settings)
        best = _placed_patiently(halved, place, room, PATIENCE[1])
    return _finished(best, paper, settings)


def _undivided(
    design: Design, plan: Plan, place: Placer, estimator: Estimator, room: Room, settings: LayoutSettings
) -> Laid:
    """The best that was found where only patches are divided that exceed the sheet."""
    plain = plain_divisions(design, room, settings)

    def others() -> list[tuple[Division, ...]]:
        return [other_divisions(one, plain[:k], design, room, settings) for k, one in enumerate(plain)]

    best: Laid | None = None

    def enough() -> bool:
        return best is not None and not best.waste(room).lacking

    for laid in lay_out_divided(
        lambda divided: plan(divided, frozenset()), place, plain, others, estimator, room, settings, enough
    ):
        opened = with_opened_folds(plan, place, laid, estimator, room, settings)
        if best is None or is_worth(opened.waste(room), best.waste(room)):
            best = opened
        if suffices(best.waste(room), best.planned.shares(room)):
            break
    assert best is not None  # at least the plainest division is laid out, or refused
    return best


def _placed_patiently(laid: Laid, place: Placer, room: Room, patience: int) -> Laid:
    """Placed anew with more orders tried, where sheets are not well filled."""
    if not laid.waste(room).lacking:
        return laid
    return min(laid, place(laid.planned, patience), key=lambda laid: laid.waste(room))


def _finished(laid: Laid, paper: Paper, settings: LayoutSettings) -> Layout:
    """Numbers for the joints, and places on the paper instead of those in the area that is used."""
    planned, corner = laid.planned, flat_motion(0.0, settings.corner(paper))
    placements = tuple(
        Placement(piece, place.sheet, corner @ place.motion)
        for piece, place in zip(planned.pieces, laid.places, strict=True)
    )
    numbers = _numbers(planned.joints, planned.flaps)
    return Layout(paper, settings, planned.parts, planned.joints, planned.pieces, numbers, placements)


def _planned(
    design: Design,
    divisions: tuple[Division, ...],
    room: Room,
    settings: LayoutSettings,
    in_the_way: InTheWay,
    barred: frozenset[str],
    recurring: Recurring,
) -> Planned:
    """All pieces, with patches divided as told, where some joints are `barred` from being folds."""
    thickness = settings.stock.thickness if settings.stock else 0.0
    listed = recurring.parts(cut_back(parts_of(design, divisions, settings.grain_axis(room)), design, thickness))
    parts = {part.id: part for part in listed}
    joints = recurring.joints(find_joints(design, listed))
    nets, flaps = plan_pieces(listed, joints, room, settings, in_the_way, barred)
    pieces = make_pieces(parts, nets, flaps)
    for piece in pieces:
        _check_size(piece, parts, room, settings)
    return Planned(parts, joints, nets, flaps, pieces, divisions, barred)


def _check_size(piece: Piece, parts: Mapping[str, Part], room: Room, settings: LayoutSettings) -> None:
    """Raise LayoutError where a piece exceeds the sheet."""
    import shapely

    if not fits(piece.outline, room, -ROUNDING, grain=settings.grain):
        shapes = [move_shape(motion, parts[name].polygon) for name, motion in piece.motions.items()]
        bare = shapely.unary_union(shapes).convex_hull
        raise too_large(f"piece {piece.name}", bare, piece.outline, room, grain=settings.grain)


def _numbers(joints: tuple[Joint, ...], flaps: tuple[Flap, ...]) -> dict[str, int]:
    glued = {flap.joint.id for flap in flaps}
    return {joint.id: k for k, joint in enumerate((j for j in joints if j.id in glued), 1)}

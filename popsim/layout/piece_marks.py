"""The marks of one piece on its sheet: pictures, places, outline, creases, numbers, name."""

from collections.abc import Iterator

import numpy as np

from popsim.geometry.flat import move, move_shape, without
from popsim.layout.fitted_text import LEGIBLE, Lettering
from popsim.layout.flap import Flap
from popsim.layout.folding import Crease
from popsim.layout.layout import Layout, Placement
from popsim.layout.perforation import perforation
from popsim.layout.piece_pictures import blank, pictures, rings
from popsim.layout.sheet import Area, Line, Mark, Role, Text
from popsim.layout.sites import Face

NUMBER_SIZE = 3.0
"""mm; font size of the numbers of glue joints, smaller where there is less room."""

BEHIND_SIZE = 2.0
"""mm; font size of numbers that stay visible, of places behind the paper."""

NAME_SIZE = 3.5
"""mm; font size of names of pieces."""

_CREASES = {Crease.MOUNTAIN: Role.MOUNTAIN, Crease.VALLEY: Role.VALLEY}


def piece_marks(layout: Layout, placement: Placement, *, two_sided: bool) -> Iterator[Mark]:
    """All marks of a piece on the printed side.

    With `two_sided` places on the reverse are left to :func:`reverse_marks`.
    """
    piece, lettering = placement.piece, _lettering(layout, placement)
    yield from pictures(layout, placement)
    yield from _casings(placement, lettering)
    for flap in piece.places:
        if flap.face is Face.PRINTED:
            yield from _glue_place(placement, flap)
    for ring in (piece.outline.exterior, *piece.outline.interiors):
        yield Line(Role.CUT, move(placement.motion, np.array(ring.coords)[:-1]), closed=True)
    for slit in piece.slits:
        yield Line(Role.CUT, move(placement.motion, slit))
    stock = layout.settings.stock
    for fold in piece.folds:
        role, ends = _CREASES[fold.crease], move(placement.motion, fold.ends)
        if stock is not None and stock.crease_advice == "perforate":
            yield from perforation(role, ends)
        else:
            yield Line(role, ends)
    for flap in piece.flaps:
        if flap.crease is Crease.NONE:  # a seam: nothing folds, the line only shows where the other part begins
            yield Line(Role.LABEL, move(placement.motion @ piece.motions[flap.carrier], flap.line))
    yield from _texts(layout, placement, lettering, two_sided)


def reverse_marks(layout: Layout, placement: Placement, width: float) -> Iterator[Mark]:
    """Places on the reverse of a piece and its name, mirrored for the back of a sheet of `width` mm."""
    import shapely

    mirror = np.array([[-1.0, 0.0, width], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    piece = placement.piece
    behind = Placement(piece, placement.sheet, mirror @ placement.motion)
    lettering = Lettering(move_shape(behind.motion, piece.outline), shapely.Polygon())
    for flap in piece.places:
        if flap.face is Face.REVERSE:
            yield from _glue_place(behind, flap)
            landing = move_shape(behind.motion @ piece.motions[flap.target], flap.landing)
            yield lettering.put(str(layout.numbers[flap.joint.id]), landing, NUMBER_SIZE)
    largest = max(piece.motions, key=lambda part: layout.parts[part].polygon.area)
    shape = move_shape(behind.motion @ piece.motions[largest], layout.parts[largest].polygon)
    yield lettering.put(piece.name, shape, NAME_SIZE)


def _glue_place(placement: Placement, flap: Flap) -> Iterator[Area]:
    landing = move_shape(placement.motion @ placement.piece.motions[flap.target], flap.landing)
    yield Area(Role.GLUE, tuple(rings(landing)))


def _casings(placement: Placement, lettering: Lettering) -> Iterator[Line]:
    """White under the creases on pictures, in whose colours they would be lost."""
    import shapely

    for fold in placement.piece.folds:
        ends = move(placement.motion, fold.ends)
        if lettering.printed.intersects(shapely.LineString(ends)):
            yield Line(Role.PRINT, ends)


def _texts(layout: Layout, placement: Placement, lettering: Lettering, two_sided: bool) -> Iterator[Text]:
    """Numbers on flaps and places, and the name of the piece, off each other."""
    piece = placement.piece
    named = _named_flap(layout, placement, lettering)
    for flap in piece.flaps:
        shape = move_shape(placement.motion @ piece.motions[flap.carrier], flap.polygon)
        yield lettering.put(_flap_text(layout, placement, flap, named=flap is named), shape, NUMBER_SIZE)
    for flap in sorted(piece.places, key=lambda flap: flap.face is Face.REVERSE):
        number = layout.numbers[flap.joint.id]
        landing = move_shape(placement.motion @ piece.motions[flap.target], flap.landing)
        if flap.face is Face.PRINTED:
            yield lettering.put(str(number), landing, NUMBER_SIZE)
        elif not two_sided:
            yield lettering.put(f"({number})", landing, BEHIND_SIZE)
    if named is None:
        yield from _name(layout, placement, lettering)


def _lettering(layout: Layout, placement: Placement) -> Lettering:
    """Texts on the printed side of a piece; pictures and blank places in them are told apart."""
    import shapely

    piece = placement.piece
    pictured = [part for part in piece.motions if layout.parts[part].patch.texture is not None]
    shapes = [
        without(
            move_shape(placement.motion @ piece.motions[part], layout.parts[part].polygon),
            blank(layout, placement, part),
        )
        for part in pictured
    ]
    return Lettering(move_shape(placement.motion, piece.outline), shapely.unary_union(shapes))


def _flap_text(layout: Layout, placement: Placement, flap: Flap, *, named: bool) -> str:
    number = str(layout.numbers[flap.joint.id])
    return f"{number} {placement.piece.name}" if named else number


def _named_flap(layout: Layout, placement: Placement, lettering: Lettering) -> Flap | None:
    """The flap that bears the name where all parts bear pictures: it is hidden once it is glued."""
    piece = placement.piece
    if any(layout.parts[part].patch.texture is None for part in piece.motions):
        return None
    fitting = []
    for flap in piece.flaps:
        shape = move_shape(placement.motion @ piece.motions[flap.carrier], flap.polygon)
        if lettering.fits(_flap_text(layout, placement, flap, named=True), shape, LEGIBLE):
            fitting.append(flap)
    return max(fitting, key=lambda flap: flap.polygon.area, default=None)


def _name(layout: Layout, placement: Placement, lettering: Lettering) -> Iterator[Text]:
    """The name of a piece in the largest free spot, of a part without picture if there is one."""
    import shapely

    piece = placement.piece
    places = [move_shape(piece.motions[flap.target], flap.landing) for flap in piece.places]
    slots = [move_shape(piece.motions[flap.carrier], flap.opening) for flap in piece.flaps if flap.opening]
    taken = shapely.unary_union([*places, *slots])
    free = []
    for part, motion in piece.motions.items():
        printed = layout.parts[part].patch.texture is not None
        for shape in shapely.get_parts(without(move_shape(motion, layout.parts[part].polygon), taken)):
            if shape.geom_type == "Polygon":
                free.append((printed, -round(shape.area, 3), shape))
    if free:
        shape = min(free, key=lambda entry: entry[:2])[2]
        yield lettering.put(piece.name, move_shape(placement.motion, shape), NAME_SIZE)

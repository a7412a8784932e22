"""Drawing a layout: marks of each piece on its sheet, and the furniture round them."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape
from popsim.layout.fitted_text import fitted_text
from popsim.layout.flaps import Flap
from popsim.layout.folding import Crease
from popsim.layout.furniture import furnish
from popsim.layout.layout import Layout, Placement
from popsim.layout.parts import Part
from popsim.layout.sheet import Area, Line, Mark, Picture, Role, Sheet, Text
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

BLEED = 1.0
"""mm of picture beyond the outline of its part, so that a cut beside the line leaves no white."""

NUMBER_SIZE = 3.0
"""mm; font size of the numbers of glue joints, smaller where there is less room."""

NAME_SIZE = 3.5
"""mm; font size of names of pieces."""

_CREASES = {Crease.MOUNTAIN: Role.MOUNTAIN, Crease.VALLEY: Role.VALLEY}


def draw_sheets(layout: Layout, *, footer: str = "", banner: str | None = None) -> tuple[Sheet, ...]:
    """Draw all sheets of a layout.

    Parameters
    ----------
    footer:
        What reproduces the sheets; printed on each.
    banner:
        A warning on each sheet, or None.
    """
    paper, count = layout.paper, layout.sheet_count
    sheets = []
    for number in range(count):
        marks = [
            mark
            for placement in layout.placements
            if placement.sheet == number
            for mark in _draw_piece(layout, placement)
        ]
        title = f"Sheet {number + 1} of {count}"
        marks += furnish(paper, layout.settings, title, footer=footer, banner=banner)
        order = list(Role)
        marks.sort(key=lambda mark: order.index(mark.role))
        sheets.append(Sheet(title, paper.width, paper.height, tuple(marks)))
    return tuple(sheets)


def _draw_piece(layout: Layout, placement: Placement) -> Iterator[Mark]:
    piece = placement.piece
    motions = {part: placement.motion @ motion for part, motion in piece.motions.items()}
    yield from _pictures(layout.parts, motions)
    for flap in piece.places:
        yield from _place(flap, layout.numbers[flap.joint.id], motions[flap.target])
    for ring in (piece.outline.exterior, *piece.outline.interiors):
        yield Line(Role.CUT, move(placement.motion, np.array(ring.coords)[:-1]), closed=True)
    for slit in piece.slits:
        yield Line(Role.CUT, move(placement.motion, slit))
    for fold in piece.folds:
        yield Line(_CREASES[fold.crease], move(placement.motion, fold.ends))
    for flap in piece.flaps:
        yield from _flap(flap, layout.numbers[flap.joint.id], motions[flap.carrier])
    yield from _name(layout, placement)


def _pictures(parts: Mapping[str, Part], motions: Mapping[str, FloatArray]) -> Iterator[Picture]:
    """Textures of the parts of a piece, bled over the outline but not over other parts."""
    import shapely

    moved = {name: move_shape(motion, parts[name].polygon) for name, motion in motions.items()}
    for name, motion in motions.items():
        patch = parts[name].patch
        if patch.texture is None or patch.texture_frame is None:
            continue
        frame = patch.texture_frame
        corner, right, up = (np.array(v) for v in (frame.origin, frame.right, frame.up))
        flat = move(motion, parts[name].flat(np.array([corner, corner + right, corner + up])))
        affine = np.eye(3)
        affine[:2, 0], affine[:2, 1], affine[:2, 2] = flat[1] - flat[0], flat[2] - flat[0], flat[0]
        others = shapely.unary_union([shape for other, shape in moved.items() if other != name])
        clip = moved[name].buffer(BLEED, join_style="mitre", mitre_limit=2).difference(others).union(moved[name])
        yield Picture(Role.PRINT, patch.texture, affine, tuple(_rings(clip)))


def _rings(shape: "BaseGeometry") -> Iterator[FloatArray]:
    import shapely

    for piece in shapely.get_parts(shape):
        if piece.geom_type == "Polygon":
            for ring in (piece.exterior, *piece.interiors):
                yield np.array(ring.coords)[:-1]


def _place(flap: Flap, number: int, motion: FloatArray) -> Iterator[Mark]:
    """Where a flap is glued: a grey area and its number, or the number in brackets where that is behind."""
    landing = move_shape(motion, flap.landing)
    if flap.face is Face.PRINTED:
        yield Area(Role.GLUE, tuple(_rings(landing)))
        yield from _number(str(number), landing)
    else:
        yield from _number(f"({number})", landing)


def _flap(flap: Flap, number: int, motion: FloatArray) -> Iterator[Mark]:
    shape = move_shape(motion, flap.polygon)
    if flap.crease is Crease.NONE:  # a seam: nothing folds, the line only shows where the other part begins
        yield Line(Role.LABEL, move(motion, flap.line))
    yield from _number(str(number), shape)


def _number(text: str, shape: "Polygon") -> Iterator[Text]:
    """A text inside `shape`, along its longest edge."""
    yield fitted_text(text, shape, NUMBER_SIZE)


def _name(layout: Layout, placement: Placement) -> Iterator[Text]:
    """The name of a piece in the widest free spot, of a part without picture if there is one."""
    import shapely

    piece = placement.piece
    taken = [move_shape(piece.motions[flap.target], flap.landing) for flap in piece.places]
    free = []
    for part, motion in piece.motions.items():
        shape = move_shape(motion, layout.parts[part].polygon).difference(shapely.unary_union(taken))
        printed = layout.parts[part].patch.texture is not None
        free += [
            (printed, -round(one.area, 3), one) for one in shapely.get_parts(shape) if one.geom_type == "Polygon"
        ]
    if free:
        shape = min(free, key=lambda entry: entry[:2])[2]
        yield fitted_text(piece.name, move_shape(placement.motion, shape), NAME_SIZE)

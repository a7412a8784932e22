"""The marks of one piece on its sheet: picture, places, outline, creases, numbers, name."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape, without
from popsim.layout.fitted_text import fitted_text
from popsim.layout.flap import Flap
from popsim.layout.folding import Crease
from popsim.layout.layout import Layout, Placement
from popsim.layout.parts import Part
from popsim.layout.sheet import Area, Line, Mark, Picture, Role, Text
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

BLEED = 1.0
"""mm of picture beyond the outline of its part, so that a cut beside the line leaves no white."""

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
    piece = placement.piece
    motions = {part: placement.motion @ motion for part, motion in piece.motions.items()}
    named = _named_flap(layout, placement)
    yield from _pictures(layout.parts, motions)
    for flap in piece.places:
        number, landing = layout.numbers[flap.joint.id], move_shape(motions[flap.target], flap.landing)
        if flap.face is Face.PRINTED:
            yield from _glue_place(number, landing)
        elif not two_sided:
            yield fitted_text(f"({number})", landing, BEHIND_SIZE)
    for ring in (piece.outline.exterior, *piece.outline.interiors):
        yield Line(Role.CUT, move(placement.motion, np.array(ring.coords)[:-1]), closed=True)
    for slit in piece.slits:
        yield Line(Role.CUT, move(placement.motion, slit))
    for fold in piece.folds:
        yield Line(_CREASES[fold.crease], move(placement.motion, fold.ends))
    for flap in piece.flaps:
        name = f" {piece.name}" if flap is named else ""
        yield from _flap(flap, f"{layout.numbers[flap.joint.id]}{name}", motions[flap.carrier])
    if named is None:
        yield from _name(layout, placement)


def reverse_marks(layout: Layout, placement: Placement, width: float) -> Iterator[Mark]:
    """Places on the reverse of a piece and its name, mirrored for the back of a sheet of `width` mm."""
    mirror = np.array([[-1.0, 0.0, width], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    piece = placement.piece
    for flap in piece.places:
        if flap.face is Face.REVERSE:
            whole = mirror @ placement.motion @ piece.motions[flap.target]
            yield from _glue_place(layout.numbers[flap.joint.id], move_shape(whole, flap.landing))
    largest = max(piece.motions, key=lambda part: layout.parts[part].polygon.area)
    shape = move_shape(mirror @ placement.motion @ piece.motions[largest], layout.parts[largest].polygon)
    yield fitted_text(piece.name, shape, NAME_SIZE)


def _glue_place(number: int, landing: "Polygon") -> Iterator[Mark]:
    yield Area(Role.GLUE, tuple(_rings(landing)))
    yield fitted_text(str(number), landing, NUMBER_SIZE)


def _flap(flap: Flap, text: str, motion: FloatArray) -> Iterator[Mark]:
    if flap.crease is Crease.NONE:  # a seam: nothing folds, the line only shows where the other part begins
        yield Line(Role.LABEL, move(motion, flap.line))
    yield fitted_text(text, move_shape(motion, flap.polygon), NUMBER_SIZE)


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
        clip = without(moved[name].buffer(BLEED, join_style="mitre", mitre_limit=2), others).union(moved[name])
        yield Picture(Role.PRINT, patch.texture, affine, tuple(_rings(clip)))


def _named_flap(layout: Layout, placement: Placement) -> Flap | None:
    """The flap that bears the name where all parts bear pictures: it is hidden once it is glued."""
    piece = placement.piece
    if not piece.flaps or any(layout.parts[part].patch.texture is None for part in piece.motions):
        return None
    return max(piece.flaps, key=lambda flap: flap.polygon.area)


def _name(layout: Layout, placement: Placement) -> Iterator[Text]:
    """The name of a piece in the largest free spot, of a part without picture if there is one."""
    import shapely

    piece = placement.piece
    taken = shapely.unary_union([move_shape(piece.motions[flap.target], flap.landing) for flap in piece.places])
    free = []
    for part, motion in piece.motions.items():
        printed = layout.parts[part].patch.texture is not None
        for shape in shapely.get_parts(without(move_shape(motion, layout.parts[part].polygon), taken)):
            if shape.geom_type == "Polygon":
                free.append((printed, -round(shape.area, 3), shape))
    if free:
        shape = min(free, key=lambda entry: entry[:2])[2]
        yield fitted_text(piece.name, move_shape(placement.motion, shape), NAME_SIZE)


def _rings(shape: "BaseGeometry") -> Iterator[FloatArray]:
    import shapely

    for piece in shapely.get_parts(shape):
        if piece.geom_type == "Polygon":
            for ring in (piece.exterior, *piece.interiors):
                yield np.array(ring.coords)[:-1]

"""The pictures on a piece, clipped with bleed, and blank where something is glued."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.flat import move, move_shape, without
from popsim.layout.layout import Layout, Placement
from popsim.layout.sheet import Picture, Role
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

from popsim.geometry.arrays import FloatArray

UNDERLAP = 0.5
"""mm of picture under the rim of what is glued onto it, so that no white shows beside it; the rest is for glue."""


def pictures(layout: Layout, placement: Placement) -> Iterator[Picture]:
    """Textures of the parts of a piece: bled over the outline, not over other parts, and not under flaps."""
    import shapely

    piece = placement.piece
    bleed = layout.settings.bleed
    motions = {name: placement.motion @ motion for name, motion in piece.motions.items()}
    moved = {name: move_shape(motion, layout.parts[name].polygon) for name, motion in motions.items()}
    for name, motion in motions.items():
        part = layout.parts[name]
        frame = part.patch.texture_frame
        if part.patch.texture is None or frame is None:
            continue
        corner, right, up = (np.array(v) for v in (frame.origin, frame.right, frame.up))
        flat = move(motion, part.flat(np.array([corner, corner + right, corner + up])))
        affine = np.eye(3)
        affine[:2, 0], affine[:2, 1], affine[:2, 2] = flat[1] - flat[0], flat[2] - flat[0], flat[0]
        others = shapely.unary_union([shape for other, shape in moved.items() if other != name])
        bled = without(moved[name].buffer(bleed, join_style="mitre", mitre_limit=2), others).union(moved[name])
        shown = without(bled, blank(layout, placement, name))
        yield Picture(Role.PRINT, part.patch.texture, affine, tuple(rings(shown)))


def blank(layout: Layout, placement: Placement, part: str) -> "BaseGeometry":
    """What of a part bears no picture, on the sheet: slots, and places of flaps but for their rims."""
    import shapely

    piece = placement.piece
    landings = [
        flap.landing.buffer(-UNDERLAP, join_style="mitre")
        for flap in piece.places
        if flap.target == part and flap.face is Face.PRINTED
    ]
    openings = [flap.opening for flap in piece.flaps if flap.carrier == part and flap.opening is not None]
    return move_shape(placement.motion @ piece.motions[part], shapely.unary_union([*landings, *openings]))


def rings(shape: "BaseGeometry") -> Iterator[FloatArray]:
    """All rings of the areas in `shape`, holes included, each (n, 2) and not closed."""
    import shapely

    for piece in shapely.get_parts(shape):
        if piece.geom_type == "Polygon":
            for ring in (piece.exterior, *piece.interiors):
                yield np.array(ring.coords)[:-1]

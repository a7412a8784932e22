"""From mechanisms and a model to patches with contours and prints (Sec. 4.3)."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Card
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.mechanisms import Mechanism, Shape
from popsim.mechanisms.assemble import page_outline
from popsim.patches.clean import without
from popsim.patches.cut import Cut, cut
from popsim.patches.piece import Piece
from popsim.patches.settings import PatchSettings
from popsim.patches.texture import Print, print_of
from popsim.rendering.parallel import THREADS
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

RENDERER = "rays"
"""Patches are always seen by rays: exact depths on every machine, with or without OpenGL."""

FOLDER = "textures"

SEEN = 1.0
"""mm^2; less of a patch inside is not worth ink."""


@dataclass(frozen=True, eq=False)
class Painted:
    """Contours and prints of patches.

    Attributes
    ----------
    shapes:
        Outline, holes and texture by patch id, for :func:`popsim.mechanisms.assemble`.
    images:
        PNG files by path relative to the design file.
    notes:
        What had to be added or left out, one sentence each.
    renderer:
        What looked at the model.
    cut_length:
        Length of all outlines and holes, mm; edges that will be folded count too.
    vertices:
        Number of corners of all outlines and holes.
    coverage:
        Share of the principal faces of each mechanism on which the model shows, 0..1, by mechanism id: what is
        far below 1 stands for little of the model.
    fins:
        Ids of the patches inside that rise through slits: both of their sides are seen, one is printed.
    """

    shapes: Mapping[str, Shape]
    images: Mapping[str, bytes]
    notes: tuple[str, ...]
    renderer: str
    cut_length: float
    vertices: int
    coverage: Mapping[str, float]
    fins: tuple[str, ...] = ()


def paint(
    mechanisms: Sequence[Mechanism],
    surface: Surface | RayScene,
    territories: Mapping[str, FloatArray],
    settings: PatchSettings | None = None,
    *,
    prints: bool = True,
) -> Painted:
    """Cut and paint the patches of mechanisms after a model.

    Parameters
    ----------
    mechanisms:
        Each stands on the card or on an earlier one.
    surface:
        The model in the card frame, mm, open pose; or the scene prepared from it.
    territories:
        Box of space whose model belongs to each mechanism, rows low and high, shape (2, 3), by mechanism id.
    settings:
        How to cut and paint.
    prints:
        Whether to print the patches; without, outlines come in a fraction of the time.

    Raises
    ------
    GeometryError
        A mechanism has no territory.
    """
    settings = settings or PatchSettings()
    scene = surface if isinstance(surface, RayScene) else RayScene(surface)
    return paint_cut(cut(mechanisms, scene, territories, settings), scene, settings, prints=prints)


def paint_cut(found: Cut, scene: RayScene, settings: PatchSettings, *, prints: bool = True) -> Painted:
    """Paint patches that are cut already; parameters as of :func:`paint`."""
    pieces, outlines = found.pieces, found.outlines
    images = _prints(scene, found, settings) if prints else {}
    shapes = {}
    for name, piece in pieces.items():
        outline, image = outlines[name], images.get(name)
        rings = [piece.plane.lift(np.array(ring.coords)[:-1]) for ring in (outline.exterior, *outline.interiors)]
        path = None if image is None else _path(name)
        shapes[name] = Shape(rings[0], tuple(rings[1:]), path, None if image is None else image.frame)
    return Painted(
        shapes=shapes,
        images={_path(name): image.png for name, image in images.items()},
        notes=found.notes,
        renderer=RENDERER,
        cut_length=float(sum(outline.length for outline in outlines.values())),
        vertices=sum(len(s.outline) + sum(len(hole) for hole in s.holes) for s in shapes.values()),
        coverage=found.coverage,
        fins=tuple(
            name for name, each in pieces.items() if not each.plate.principal and found.overhang[name] > SEEN
        ),
    )


def with_base(painted: Painted, prints: Mapping[str, Print], card: Card) -> Painted:
    """The same with prints on ground and backdrop."""
    signs = {GROUND_ID: 1, BACKDROP_ID: -1}
    shapes = {
        name: Shape(page_outline(card, signs[name]), (), _path(name), each.frame) for name, each in prints.items()
    }
    images = {_path(name): each.png for name, each in prints.items()}
    return replace(painted, shapes={**shapes, **painted.shapes}, images={**images, **painted.images})


def _prints(scene: RayScene, found: Cut, settings: PatchSettings) -> dict[str, Print]:
    """Prints of the patches that show something, fins of patches inside too, by patch id."""
    shown = [piece for piece in found.pieces.values() if piece.plate.principal or found.overhang[piece.id] > SEEN]

    def visible(piece: Piece) -> "BaseGeometry":
        outline = found.outlines[piece.id]
        return outline if piece.plate.principal else without(outline, piece.face)

    with ThreadPoolExecutor(THREADS) as pool:  # rays, filters and compression free the interpreter
        made = pool.map(lambda piece: print_of(scene, piece, visible(piece), settings), shown)
        return {piece.id: image for piece, image in zip(shown, made, strict=True) if image is not None}


def _path(name: str) -> str:
    return f"{FOLDER}/{name}.png"

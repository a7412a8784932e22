"""From mechanisms and a model to patches with contours and prints (Sec. 4.3)."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.surface import Surface
from popsim.mechanisms import Mechanism, Shape
from popsim.patches.clean import common, cuttable
from popsim.patches.corners import clear_corners
from popsim.patches.crossing import Meeting, uncross
from popsim.patches.hold import hold
from popsim.patches.one_piece import finished
from popsim.patches.piece import Piece, pieces_of
from popsim.patches.settings import PatchSettings
from popsim.patches.texture import Print, print_of
from popsim.patches.wanted import see
from popsim.rendering.parallel import THREADS
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry import Polygon

RENDERER = "rays"
"""Patches are always seen by rays: exact depths on every machine, with or without OpenGL."""

FOLDER = "textures"


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
    """

    shapes: Mapping[str, Shape]
    images: Mapping[str, bytes]
    notes: tuple[str, ...]
    renderer: str
    cut_length: float
    vertices: int
    coverage: Mapping[str, float]


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
    pieces: dict[str, Piece] = {}
    for mechanism in mechanisms:
        box = _territory(mechanism, territories)
        pieces |= {piece.id: piece for piece in pieces_of(mechanism, box, settings)}
    clear_corners(mechanisms, pieces)
    for piece in pieces.values():
        see(scene, piece, settings)
        piece.shape = cuttable(piece.shape, piece.room, settings)
    coverage = {mechanism.id: _coverage(mechanism, pieces) for mechanism in mechanisms}
    notes = _joined(mechanisms, pieces, settings)
    outlines: dict[str, Polygon] = {}
    for name, piece in pieces.items():
        outlines[name], own = finished(piece, settings)
        notes += own
    seen = _prints(scene, pieces, outlines, settings) if prints else {}
    return _painted(pieces, outlines, seen, notes, coverage)


def _territory(mechanism: Mechanism, territories: Mapping[str, FloatArray]) -> FloatArray:
    if mechanism.id not in territories:
        raise GeometryError(f"{mechanism.id} has no territory; give the box of space whose model it shows")
    return locked(territories[mechanism.id], (2, 3), f"territory of {mechanism.id}")


def _coverage(mechanism: Mechanism, pieces: Mapping[str, Piece]) -> float:
    shown = [pieces[mechanism.patch_id(plate.role)] for plate in mechanism.plates() if plate.principal]
    seen = sum(common(piece.shape, piece.face).area for piece in shown)
    return float(seen / sum(piece.face.area for piece in shown))


def _joined(mechanisms: Sequence[Mechanism], pieces: Mapping[str, Piece], settings: PatchSettings) -> list[str]:
    """Paper for all hinges, and no two patches through each other; returns notes."""
    meetings: dict[str, Meeting] = {}
    for mechanism in mechanisms:
        for joint in mechanism.joints():
            names = [mechanism.patch_id(role) for role in joint.roles]
            found = [pieces[name] for name in names if name in pieces]
            meetings[" and ".join(names)] = Meeting(joint.axis, found)
    uncross(list(meetings.values()))
    reached = {names: hold(meeting.runs(), settings) for names, meeting in meetings.items()}
    return [f"{names}: strips of the face reach for their hinge" for names, strips in reached.items() if strips]


def _prints(
    scene: RayScene, pieces: Mapping[str, Piece], outlines: Mapping[str, "Polygon"], settings: PatchSettings
) -> dict[str, Print]:
    """Prints of the patches that show something, by patch id."""
    shown = [piece for piece in pieces.values() if piece.plate.principal]
    with ThreadPoolExecutor(THREADS) as pool:  # rays, filters and compression free the interpreter
        found = pool.map(lambda piece: print_of(scene, piece, outlines[piece.id], settings), shown)
        return {piece.id: image for piece, image in zip(shown, found, strict=True) if image is not None}


def _painted(
    pieces: Mapping[str, Piece],
    outlines: Mapping[str, "Polygon"],
    prints: Mapping[str, Print],
    notes: list[str],
    coverage: Mapping[str, float],
) -> Painted:
    shapes = {}
    for name, piece in pieces.items():
        outline, image = outlines[name], prints.get(name)
        rings = [piece.plane.lift(np.array(ring.coords)[:-1]) for ring in (outline.exterior, *outline.interiors)]
        path = None if image is None else _path(name)
        shapes[name] = Shape(rings[0], tuple(rings[1:]), path, None if image is None else image.frame)
    return Painted(
        shapes=shapes,
        images={_path(name): image.png for name, image in prints.items()},
        notes=tuple(notes),
        renderer=RENDERER,
        cut_length=float(sum(outline.length for outline in outlines.values())),
        vertices=sum(len(s.outline) + sum(len(hole) for hole in s.holes) for s in shapes.values()),
        coverage=coverage,
    )


def _path(name: str) -> str:
    return f"{FOLDER}/{name}.png"

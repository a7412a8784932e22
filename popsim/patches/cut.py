"""From mechanisms and a model to the outlines of patches (Sec. 4.3)."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked
from popsim.mechanisms import AS_THEY_ARE, Depths, Mechanism, plates_together
from popsim.mechanisms.plate import FIRST_BASE, SECOND_BASE
from popsim.patches.clean import common, cuttable, without
from popsim.patches.crossing import Meeting, uncross
from popsim.patches.hold import hold
from popsim.patches.one_piece import finished
from popsim.patches.piece import Piece, pieces_of
from popsim.patches.settings import PatchSettings
from popsim.patches.slits import cut_slits
from popsim.patches.wanted import see
from popsim.rendering.parallel import THREADS
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry import Polygon


@dataclass(frozen=True, eq=False)
class Cut:
    """Outlines of patches, before anything is printed on them.

    Attributes
    ----------
    pieces:
        The plates they were cut from, by patch id.
    outlines:
        In the flat coordinates of the pieces, by patch id.
    notes:
        What had to be added or left out, one sentence each.
    coverage:
        As in :class:`popsim.patches.paint.Painted`.
    """

    pieces: Mapping[str, Piece]
    outlines: Mapping[str, "Polygon"]
    notes: tuple[str, ...]
    coverage: Mapping[str, float]

    @cached_property
    def overhang(self) -> dict[str, float]:
        """Paper beyond the face of each patch, mm^2, by patch id."""
        return {name: float(without(self.outlines[name], piece.face).area) for name, piece in self.pieces.items()}


def cut(
    mechanisms: Sequence[Mechanism],
    scene: RayScene,
    territories: Mapping[str, FloatArray],
    settings: PatchSettings,
    depths: Depths = AS_THEY_ARE,
) -> Cut:
    """Cut the patches of mechanisms after the silhouettes of a model; see :func:`popsim.patches.paint.paint`.

    `depths` are factors on how deep plates show the model, see :func:`popsim.mechanisms.plates_together`.
    """
    pieces: dict[str, Piece] = {}
    plates = plates_together(mechanisms, depths)
    for mechanism in mechanisms:
        box = _territory(mechanism, territories)
        pieces |= {piece.id: piece for piece in pieces_of(mechanism, plates[mechanism.id], box, settings)}

    def find(piece: Piece) -> None:
        see(scene, piece, settings)
        piece.shape = cuttable(piece.shape, piece.room, settings)

    with ThreadPoolExecutor(THREADS) as pool:  # rays and overlays free the interpreter
        list(pool.map(find, pieces.values()))
    coverage = {mechanism.id: _coverage(mechanism, pieces) for mechanism in mechanisms}
    meetings = _meetings(mechanisms, pieces, settings)
    uncross(meetings)
    notes = _held(meetings, settings)
    outlines: dict[str, Polygon] = {}
    for name, piece in pieces.items():
        outlines[name], own = finished(piece, settings)
        notes += own
    cut_slits(meetings, outlines, settings)
    return Cut(pieces, outlines, tuple(notes), coverage)


def _territory(mechanism: Mechanism, territories: Mapping[str, FloatArray]) -> FloatArray:
    if mechanism.id not in territories:
        raise GeometryError(f"{mechanism.id} has no territory; give the box of space whose model it shows")
    return locked(territories[mechanism.id], (2, 3), f"territory of {mechanism.id}")


def _coverage(mechanism: Mechanism, pieces: Mapping[str, Piece]) -> float:
    shown = [pieces[mechanism.patch_id(plate.role)] for plate in mechanism.plates() if plate.principal]
    seen = sum(common(piece.shape, piece.face).area for piece in shown)
    return float(seen / sum(piece.face.area for piece in shown))


def _meetings(
    mechanisms: Sequence[Mechanism], pieces: Mapping[str, Piece], settings: PatchSettings
) -> list[Meeting]:
    """The lines of all joints, with the pieces that are hinged there."""
    found = []
    for mechanism in mechanisms:
        for joint in mechanism.joints():
            names = tuple(mechanism.patch_id(role) for role in joint.roles)
            stands = FIRST_BASE in joint.roles or SECOND_BASE in joint.roles
            snap = settings.snap if stands else settings.seam
            found.append(Meeting(joint.axis, [pieces[name] for name in names if name in pieces], names, snap))
    return found


def _held(meetings: Sequence[Meeting], settings: PatchSettings) -> list[str]:
    """Paper for all hinges; returns notes."""
    notes = []
    for meeting in meetings:
        share = settings.share(frozenset(meeting.names))
        strips = hold(meeting.runs(), replace(settings, least_share=share), meeting.snap, meeting.mates(meetings))
        if strips:
            more = "" if share == settings.least_share else f", {share:.0%} of it, for no flap fits on less"
            notes.append(f"{' and '.join(meeting.names)}: strips of the face reach for their hinge{more}")
    return notes

"""How far outlines lie off the contours of the model, where no rule moves them."""

from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import LineString

from popsim.mechanisms import AS_THEY_ARE
from popsim.patches import cut as cutting
from popsim.patches import one_piece
from popsim.patches.clean import closed, cuttable, opened
from popsim.patches.legs import legs
from popsim.patches.sight import Grid, look, shows
from popsim.patches.silhouette import mask_polygon
from popsim.patches.wanted import REACH, depths

FINE = 0.1
"""mm; pixels of the contours that outlines are held against, half those that they are cut after."""

BESIDE = 0.5
"""mm around what a rule has changed in which nothing is measured."""

STEP = 0.1
"""mm between the points that are measured."""


@dataclass(frozen=True)
class Departure:
    """Distances of points of a patch's outline from the contour, and of the contour's from the outline, mm."""

    patch: str
    outward: np.ndarray
    back: np.ndarray


def departures(mechanisms, scene, boxes, settings, monkeypatch, factors=AS_THEY_ARE):
    """Departures of all patches that show something; parameters as of :func:`popsim.patches.cut.cut`.

    Nothing is measured beside edges of faces and rooms and beside hinges (outlines go to them), where paper or
    gaps are too narrow to cut (strips are made wider, to either side by up to half of what can be cut), at legs,
    where two overhangs would cross, at slits, bridges, and islands left out. What a rule leaves too narrow counts
    as what is so in the model: the rest of an overhang, a gap between strips that were made wider.
    """
    changed = _changes(monkeypatch)
    found = cutting.cut(mechanisms, scene, boxes, settings, factors)
    shown = [piece for piece in found.pieces.values() if piece.plate.principal]
    return [_departure(piece, found.outlines[piece.id], mechanisms, scene, settings, changed) for piece in shown]


def _changes(monkeypatch):
    """What the rules change in shapes while patches are cut, by patch id."""
    changed = {}
    uncross, join, slit = cutting.uncross, one_piece.in_one_piece, cutting.cut_slits

    def note(name, before, after):
        changed.setdefault(name, []).append(before.symmetric_difference(after))

    def noted_uncross(meetings):
        pieces = {piece.id: piece for meeting in meetings for piece in meeting.pieces}
        before = {name: piece.shape for name, piece in pieces.items()}
        uncross(meetings)
        for name, piece in pieces.items():
            note(name, before[name], piece.shape)

    def noted_join(parts, piece):
        outline, notes = join(parts, piece)
        note(piece.id, shapely.union_all(parts), shapely.Polygon() if outline is None else outline)
        return outline, notes

    def noted_slits(meetings, outlines, settings):
        before = dict(outlines)
        slit(meetings, outlines, settings)
        for name in outlines:
            note(name, before[name], outlines[name])

    monkeypatch.setattr(cutting, "uncross", noted_uncross)
    monkeypatch.setattr(one_piece, "in_one_piece", noted_join)
    monkeypatch.setattr(cutting, "cut_slits", noted_slits)
    return changed


def _departure(piece, outline, mechanisms, scene, settings, changed):
    grid = Grid.over(piece.plane, piece.room.bounds, FINE)
    mask = shows(scene, grid, piece.box, -REACH, depths(piece, grid, piece.room))
    if not piece.recesses.is_empty:
        dents = np.where(grid.covered(piece.recesses), REACH, np.nan)
        mask |= shows(scene, grid, piece.box, -REACH, dents)
    shape = mask_polygon(mask, grid)
    narrow = shape.symmetric_difference(cuttable(shape, piece.room, settings))
    narrow = shapely.union_all([narrow, _thin(shape, settings), _thin(piece.shape, settings)])
    coarse = Grid.over(piece.plane, piece.room.bounds, settings.pixel)
    sight = look(scene, coarse, piece.box, -REACH, depths(piece, coarse, piece.room), bary=False)
    upright = piece.stands or piece.plate.lies
    left_out = shapely.Polygon() if upright else mask_polygon(legs(sight, piece), coarse)
    hinges = [
        LineString(piece.plane.flat(joint.axis))
        for mechanism in mechanisms
        for joint in mechanism.joints()
        if piece.id in [mechanism.patch_id(role) for role in joint.roles]
    ]
    ruled = shapely.union_all(
        [
            piece.face.boundary.buffer(settings.snap + FINE),
            piece.room.boundary.buffer(BESIDE),
            *(hinge.buffer(settings.seam + FINE) for hinge in hinges),
            *(area.buffer(2 * BESIDE) for area in piece.held),
            *(area.buffer(BESIDE) for area in [narrow, left_out, *changed[piece.id]]),
        ]
    )
    ours, theirs = outline.boundary, shape.boundary
    return Departure(piece.id, _distances(ours, theirs, ruled), _distances(theirs, ours, ruled))


def _thin(shape, settings):
    """Where a shape or a gap in it is too narrow to cut, and where what is made wide enough to cut may reach.

    What is wider by no more than two pixels may have been too narrow in the pixels that outlines are cut after.
    """
    least = settings.thinnest + 2 * settings.pixel
    gaps, strips = closed(shape, least).difference(shape), shape.difference(opened(shape, least))
    return shapely.union_all([gaps, strips.buffer(settings.thinnest / 2)])


def _distances(line, other, ruled):
    """Distances of points of a line, outside what is ruled, from another one."""
    free = line.difference(ruled)
    points = shapely.get_coordinates(shapely.segmentize(free, STEP)) if not free.is_empty else np.zeros((0, 2))
    return shapely.distance(shapely.points(points), other)

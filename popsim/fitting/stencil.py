"""Where on a plate the model will show once contours are cut."""

from dataclasses import dataclass
from math import ceil, floor

import numpy as np

from popsim.fitting.fronts import Fronts
from popsim.fitting.legs import legs
from popsim.fitting.masks import FAR, FloatImage, extent, grown, parts
from popsim.fitting.slant import ACROSS, Slant
from popsim.fitting.strips import add_strips
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import Plate
from popsim.stock import NEAR_EDGE, THINNEST_STRIP

SPARSE = 0.05
"""A face on which the model shows on less than this share stays whole: its hinges need paper to hold. A ring or a
lattice shows on more."""

RECTANGLE, STRAIGHT = 4, 1e-9
"""Corners of a rectangle along the axes, and by how little, mm, its edges leave them."""

ALONG = 0.5
"""A plate whose normal makes a greater |cos| with y does not go on over the fold."""

MARGIN = 2
"""Cells around all that can show; the outermost ones show nothing."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """A mask over the plane of a plate.

    Attributes
    ----------
    slant:
        The plane.
    low, grain:
        Corner where the cells start, and their sides, along the coordinates of the slant, mm, each of shape (2,).
    mask:
        In which cells the model shows, shape (n, m).
    face:
        Cells of the face of the plate, shape (n, m).
    """

    slant: Slant
    low: FloatArray
    grain: FloatArray
    mask: BoolArray
    face: BoolArray

    @staticmethod
    def of(plate: Plate, fronts: Fronts) -> "Stencil":
        """Hold a plate against a model.

        Within the face what lies no deeper shows, and what that encloses; beyond the face what lies near, but not
        what hangs in the air there or is but a seam along the face; and no legs. Patches inside show what both
        sides hide. Strips reach for hinges that hold nowhere else.
        """
        assert plate.room is not None  # plates give themselves room
        slant = Slant.of(plate.outward, plate.outline[0])
        outline, room = slant.seen(plate.outline), slant.seen(plate.room)
        low, grain, (s, t) = _cells(outline, room, fronts.bounds[:, ACROSS[slant.axis]], fronts.pixel)
        inside = within(s, t, outline)
        free = within(s, t, room) & ~inside
        face, near, there, behind = _seen(plate, slant, s, t, fronts)
        standing = ~legs(plate, behind, (face & inside) | (near & free), inside)
        face, near = face & standing, near & standing
        beyond, shown = near & free, _held(face & inside, inside, fronts.pixel)
        dents = there & inside & ~face
        if dents.any():
            shown = shown | (_enclosed(shown | grown(beyond) | _walls(plate, slant, (s, t), inside)) & dents)
        if plate.principal and np.count_nonzero(shown) < SPARSE * np.count_nonzero(inside):
            shown = inside
        elif plate.principal:
            add_strips(shown, slant.seen(plate.hinges), low, grain, inside)
        return Stencil(
            slant, low, grain, shown | (_attached(shown, inside, beyond, fronts.pixel) & ~inside), inside
        )

    @property
    def box(self) -> tuple[FloatArray, FloatArray]:
        """Low and high corner of what shows, each of shape (2,)."""
        first, last = extent(self.mask)
        return self.low + first * self.grain, self.low + last * self.grain

    @property
    def picture(self) -> FloatImage:
        """0 where the model shows, FAR elsewhere, shape (n, m)."""
        return np.where(self.mask, np.float32(0.0), FAR)


def _cells(
    outline: FloatArray, room: FloatArray, bounds: FloatArray, length: float
) -> tuple[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Cells of about one length over a face and what of its room lies in the bounds of a model.

    The face begins and ends with a cell.

    Returns
    -------
    tuple
        Corner where the cells start (2,), their sides (2,), and the coordinates of their rows (n, 1) and columns
        (1, m).
    """
    low, grain, centres = [], [], []
    for face, free, (first, last) in zip(outline.T.tolist(), room.T.tolist(), bounds.T.tolist(), strict=True):
        least, most = min(face), max(face)
        side = (most - least) / max(round((most - least) / length), 1)
        start = floor((min(least, max(min(free), first)) - least) / side) - MARGIN
        stop = ceil((max(most, min(max(free), last)) - least) / side) + MARGIN
        low.append(least + start * side)
        grain.append(side)
        centres.append(least + (np.arange(start, stop) + 0.5) * side)
    return np.array(low), np.array(grain), (centres[0][:, None], centres[1][None])


def _seen(
    plate: Plate, slant: Slant, s: FloatArray, t: FloatArray, fronts: Fronts
) -> tuple[BoolArray, BoolArray, BoolArray, FloatArray]:
    """Where a plate would show the model in its face, where beyond it, where there is any, and how deep, mm."""
    place = slant.along(s, t)
    behind = slant.sign * place - fronts.reach(slant.axis, slant.sign, s[:, 0], t[0])
    near, there = behind <= plate.beside, np.isfinite(behind)
    if plate.principal:
        return (behind <= plate.behind) & there, near & there, there, behind
    other = -slant.sign * place - fronts.reach(slant.axis, -slant.sign, s[:, 0], t[0])
    hidden = np.isfinite(other)
    return there & hidden, near & (other <= plate.beside), there | hidden, behind


def _held(shown: BoolArray, inside: BoolArray, side: float) -> BoolArray:
    """What a face shows, and the cells from there to its border where that is near: hinges need paper."""
    steps = max(round(NEAR_EDGE / side), 1)
    return shown | (inside & grown(~inside, steps) & grown(shown, steps))


def _walls(plate: Plate, slant: Slant, cells: tuple[FloatArray, FloatArray], inside: BoolArray) -> BoolArray:
    """Cells at the foot of an upright face, and those over the fold, where it goes on on the other side.

    `cells` are the coordinates of their rows and columns, `inside` tells which are in the face.
    """
    walls = np.zeros(inside.shape, dtype=bool)
    columns, rows = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    if not len(columns):
        return walls
    across, along = slice(columns[0], columns[-1] + 1), slice(rows[0], rows[-1] + 1)
    if not plate.lies:
        walls[across, max(rows[0] - 1, 0)] = True
    if abs(plate.outward[1]) < ALONG:
        y = cells[ACROSS[slant.axis].index(1)]
        beyond = np.broadcast_to(np.sign(plate.outline[:, 1].sum()) * y <= 0, inside.shape)
        walls[_widened(across), along] |= beyond[_widened(across), along]
        walls[across, _widened(along)] |= beyond[across, _widened(along)]
    return walls


def _widened(span: slice) -> slice:
    """A span and a cell at either end."""
    return slice(max(span.start - 1, 0), span.stop + 1)


def _enclosed(closed: BoolArray) -> BoolArray:
    """Closed cells, and those from which there is no way out."""
    count, labels = parts(~closed)
    inner = np.ones(count, dtype=bool)
    for border in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        inner[border] = False
    inner[0] = True
    return inner.take(labels)


def _attached(shown: BoolArray, inside: BoolArray, beyond: BoolArray, side: float) -> BoolArray:
    """What hangs together with what a face shows, and is more than a seam along it."""
    if not beyond.any():
        return beyond
    steps = max(round(THINNEST_STRIP / side) - 1, 1)
    far = beyond & ~grown(inside, steps)
    if not far.any():
        return far
    kept = far | (beyond & grown(far, steps, around=True))
    count, labels = parts(grown(shown | kept))
    joined = np.zeros(count, dtype=bool)
    joined[labels[shown]] = True
    return np.asarray(kept & joined.take(labels))


def within(x: FloatArray, y: FloatArray, ring: FloatArray) -> BoolArray:
    """Whether points lie in a simple polygon (n, 2); their coordinates have any shapes that broadcast."""
    corners = ring.tolist()
    edges = list(zip(corners, corners[1:] + corners[:1], strict=True))
    if len(edges) == RECTANGLE and all(min(abs(x1 - x0), abs(y1 - y0)) < STRAIGHT for (x0, y0), (x1, y1) in edges):
        (left, *_, right), (lower, *_, upper) = (sorted(values) for values in zip(*corners, strict=True))
        return np.asarray(((x > left) & (x < right)) & ((y > lower) & (y < upper)))
    steep = [edge for edge in edges if edge[0][1] != edge[1][1]]
    x0, y0, x1, y1 = np.array(steep).reshape(-1, 4).T[(..., *(None,) * y.ndim)]
    crossed = (y >= y0) != (y >= y1)
    ends = np.where(crossed, np.where(x0 == x1, x0, x0 + (y - y0) * ((x1 - x0) / (y1 - y0))), -np.inf)
    return np.asarray(np.logical_xor.reduce(x < ends, axis=0))

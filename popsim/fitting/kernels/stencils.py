"""What plates show of a model, cell by cell (:class:`popsim.fitting.stencil.Stencil`)."""

import numpy as np

from popsim.fitting.kernels.cells import counted, divided, extent, grown, grown_by, reached, square_around, within
from popsim.fitting.kernels.compiled import compiled
from popsim.fitting.kernels.hinges import add_strips
from popsim.fitting.kernels.records import Ends, Held, Seen
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.stock import NEAR_EDGE, THINNEST_STRIP

SPARSE = 0.05
"""A face on which the model shows on less than this share stays whole: its hinges need paper to hold. A ring or a
lattice shows on more."""

MARGIN = 2
"""Cells around all that can show; the outermost ones show nothing."""


@compiled
def stencil(
    plate: Seen, ends: Ends, plane: tuple[float, float, float], walls: tuple[bool, int, float]
) -> tuple[FloatArray, FloatArray, BoolArray, BoolArray, float]:
    """Hold a plate against a model, and tell where that shows, legs included.

    Returns
    -------
    tuple
        Of :class:`Held` `low`, `grain` and `inside`; between the last two what :func:`shown` gives; and `deepest`.
    """
    own = held(plate, ends, plane)
    return own.low, own.grain, shown(own, ends.pixel, plate, walls), own.inside, own.deepest


@compiled
def held(plate: Seen, ends: Ends, plane: tuple[float, float, float]) -> Held:
    """Hold a plate against a model.

    Parameters
    ----------
    plate:
        In the coordinates s and t of its slant.
    ends:
        The model along the axis that it faces most.
    plane:
        Its coordinate along that axis is ``plane[0] + plane[1] * s + plane[2] * t``.
    """
    outline, room = plate.outline, plate.room
    starts, sides = np.empty(2), np.empty(2)
    s0, side, s = divided(outline[:, 0], room[:, 0], ends.bounds[0, 0], ends.bounds[1, 0], ends.pixel, MARGIN)
    starts[0], sides[0] = s0, side
    ceiling, highest = _ceiling(s, plate.taken), ends.bounds[1, 1]
    if len(ceiling):
        highest = min(highest, ceiling.max())
    t0, side, t = divided(outline[:, 1], room[:, 1], ends.bounds[0, 1], highest, ends.pixel, MARGIN)
    starts[1], sides[1] = t0, side
    inside, free = within(s, t, outline), within(s, t, room)
    for i in range(len(ceiling)):
        for j in range(len(t)):
            free[i, j] &= t[j] < ceiling[i]
    rows = _pixels(s, ends.start[0], ends.pixel, ends.near.shape[0])
    columns = _pixels(t, ends.start[1], ends.pixel, ends.near.shape[1])
    face, beyond = np.zeros(inside.shape, np.bool_), np.zeros(inside.shape, np.bool_)
    there, behind = np.zeros(inside.shape, np.bool_), np.full(inside.shape, np.inf)
    deepest = -np.inf
    for i in range(len(s)):
        level, near, far = plane[0] + plane[1] * s[i], ends.near[rows[i]], ends.far[rows[i]]
        for j in range(len(t)):
            own = inside[i, j]
            if not (own or free[i, j]):
                continue
            place = ends.sign * (level + plane[2] * t[j])
            deep = place - near[columns[j]]
            behind[i, j] = deep
            if plate.principal:
                there[i, j] = own and deep < np.inf
                shows = deep < np.inf and deep <= (plate.behind if own else plate.beside)
            else:
                other = -place - far[columns[j]]
                there[i, j] = own and min(deep, other) < np.inf
                shows = max(deep, other) < np.inf and (own or max(deep, other) <= plate.beside)
            if shows:
                face[i, j], beyond[i, j] = own, not own
                deepest = max(deepest, deep)
    return Held(starts, sides, s, t, inside, face, beyond, there, behind, deepest)


@compiled
def _ceiling(s: FloatArray, taken: FloatArray) -> FloatArray:
    """From which height on others take what is over each of some places, shape (n,); empty where they do not."""
    found = np.full(len(s) if len(taken) else 0, np.inf)
    for k in range(len(taken)):
        for i in range(len(s)):
            if taken[k, 0] < s[i] < taken[k, 1]:
                found[i] = min(found[i], taken[k, 2])
    return found


@compiled
def _pixels(places: FloatArray, start: float, pixel: float, count: int) -> IntArray:
    """Which of some pixels, or of those at the ends, hold places, shape (n,)."""
    found = np.empty(len(places), np.int64)
    for k in range(len(places)):
        found[k] = min(max(int(np.floor((places[k] - start) / pixel)) + 1, 0), count - 1)
    return found


@compiled
def shown(own: Held, side: float, plate: Seen, walls: tuple[bool, int, float]) -> BoolArray:
    """Cells in which a plate shows the model, shape (n, m).

    Parameters
    ----------
    own:
        How it is held against the model.
    side:
        Of cells, about, mm.
    plate:
        As in :func:`held`.
    walls:
        Whether it stands upright; the coordinate (0 s, 1 t) that leads over the fold, -1 where it does not go on
        there; and on which side of the fold it lies.
    """
    found = own.face.copy()
    if _any_but(own.inside, own.face):
        _go_on_to_the_edge(found, own, max(round(NEAR_EDGE / side), 1))
        if _any_but(own.there, own.face):
            closed = grown(own.beyond)
            _join(closed, found)
            _wall_up(closed, own, walls)
            _fill(found, closed, own)
    if plate.principal:
        if counted(found) < SPARSE * counted(own.inside):
            _join(found, own.inside)
        else:
            add_strips(found, plate.hinges, own.low, own.grain, own.inside)
    steps = max(round(THINNEST_STRIP / side) - 1, 1)
    seam = grown_by(own.inside, steps)
    if _any_but(own.beyond, seam):
        _attach(found, own.beyond, seam, steps)
    return found


@compiled
def _any_but(mask: BoolArray, other: BoolArray) -> bool:
    """Whether a mask holds any cell that another one does not."""
    cells, others = mask.view(np.uint8), other.view(np.uint8)
    for i in range(mask.shape[0]):
        own, others_own, found = cells[i], others[i], np.uint8(0)
        for j in range(mask.shape[1]):
            found |= own[j] & ~others_own[j]
        if found & 1:
            return True
    return False


@compiled
def _join(mask: BoolArray, other: BoolArray) -> None:
    """Add the cells of another mask to one."""
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            mask[i, j] |= other[i, j]


@compiled
def _go_on_to_the_edge(found: BoolArray, own: Held, steps: int) -> None:
    """Add to what a face shows the cells from there to its border where that is near: hinges need paper."""
    rows, columns = own.inside.shape
    outside = np.empty((rows, columns), np.bool_)
    for i in range(rows):
        for j in range(columns):
            outside[i, j] = not own.inside[i, j]
    near, border = grown_by(own.face, steps), grown_by(outside, steps)
    for i in range(rows):
        for j in range(columns):
            found[i, j] |= own.inside[i, j] & border[i, j] & near[i, j]


@compiled
def _fill(found: BoolArray, closed: BoolArray, own: Held) -> None:
    """Add the dents of a face from which no way leads out between closed cells."""
    rows, columns = closed.shape
    ways, border = np.empty(closed.shape, np.bool_), np.empty(closed.shape, np.bool_)
    for i in range(rows):
        for j in range(columns):
            ways[i, j] = not closed[i, j]
            border[i, j] = i in (0, rows - 1) or j in (0, columns - 1)
    out = reached(ways, border)
    for i in range(rows):
        for j in range(columns):
            found[i, j] |= own.there[i, j] and not own.face[i, j] and not out[i, j]


@compiled
def _wall_up(closed: BoolArray, own: Held, walls: tuple[bool, int, float]) -> None:
    """Close the cells at the foot of an upright face, and those over the fold, where it goes on beyond."""
    upright, coordinate, sign = walls
    first, last, least, most = extent(own.inside)
    if last <= first:
        return
    if upright:
        closed[first:last, max(least - 1, 0)] = True
    if coordinate < 0:
        return
    for i in range(max(first - 1, 0), min(last + 1, closed.shape[0])):
        for j in range(max(least - 1, 0), min(most + 1, closed.shape[1])):
            corner = not first <= i < last and not least <= j < most
            if not corner and sign * (own.s[i] if coordinate == 0 else own.t[j]) <= 0:
                closed[i, j] = True


@compiled
def _attach(found: BoolArray, beyond: BoolArray, seam: BoolArray, steps: int) -> None:
    """Add what hangs together with what a face shows, and reaches further from it than a seam of some cells."""
    rows, columns = found.shape
    far = np.empty((rows, columns), np.bool_)
    for i in range(rows):
        for j in range(columns):
            far[i, j] = beyond[i, j] & (not seam[i, j])
    kept = square_around(far, steps)
    joined = np.empty((rows, columns), np.bool_)
    for i in range(rows):
        for j in range(columns):
            kept[i, j] &= beyond[i, j]
            joined[i, j] = kept[i, j] | found[i, j]
    together = reached(grown(joined), found)
    for i in range(rows):
        for j in range(columns):
            found[i, j] |= kept[i, j] & together[i, j]

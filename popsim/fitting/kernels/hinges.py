"""Hinges among the cells of a stencil: strips that reach for them, and what shows beyond them."""

from math import ceil

import numpy as np

from popsim.fitting.kernels.compiled import compiled
from popsim.fitting.kernels.records import Line
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.stock import HINGE_LENGTH, HINGE_SHARE, NEAR_EDGE, least_hold

STRAIGHT = 1e-6
"""mm; hinges that leave the rows and columns of the cells by more are left alone."""

_least_hold = compiled(least_hold)


@compiled
def lines_among(
    hinges: FloatArray, low: FloatArray, grain: FloatArray, face: BoolArray
) -> tuple[IntArray, IntArray]:
    """Those of some hinges that run along an edge of a face and along its cells.

    Parameters
    ----------
    hinges:
        Their ends in the coordinates of the cells, mm, shape (k, 2, 2).
    low, grain:
        Corner where the cells start and their sides, mm, each of shape (2,).
    face:
        Cells in the face, shape (n, m).

    Returns
    -------
    tuple
        The place of each among the hinges, shape (l,), and the fields of its :class:`Line`, shape (l, 5).
    """
    places, lines = np.empty(len(hinges), np.int64), np.empty((len(hinges), 5), np.int64)
    count = 0
    for place in range(len(hinges)):
        if abs(hinges[place, 1, 1] - hinges[place, 0, 1]) < STRAIGHT:
            along = 0
        elif abs(hinges[place, 1, 0] - hinges[place, 0, 0]) < STRAIGHT:
            along = 1
        else:
            continue
        start = (hinges[place, 0, along] - low[along]) / grain[along]
        end = (hinges[place, 1, along] - low[along]) / grain[along]
        first, last = max(round(min(start, end)), 0), round(max(start, end))
        border = round((hinges[place, 0, 1 - along] - low[1 - along]) / grain[1 - along])
        if last <= first or not 0 < border < face.shape[1 - along]:
            continue
        middle = (first + last) // 2
        above = face[middle, border] if along == 0 else face[border, middle]
        below = face[middle, border - 1] if along == 0 else face[border - 1, middle]
        if above != below:
            places[count] = place
            lines[count, 0], lines[count, 1], lines[count, 2] = along, first, last
            lines[count, 3], lines[count, 4] = border, above
            count += 1
    return places[:count], lines[:count]


@compiled
def _line(fields: IntArray) -> Line:
    return Line(fields[0], fields[1], fields[2], fields[3], fields[4] == 1)


@compiled
def add_strips(shown: BoolArray, hinges: FloatArray, low: FloatArray, grain: FloatArray, face: BoolArray) -> None:
    """Add to what a face shows the strips without which its hinges would not hold.

    Each line along an edge of the face needs a share of its length. What shows nearest to it is joined first, and
    of what is equally near that beside what reaches it already (see :mod:`popsim.patches.hold`). `shown` is of
    shape (n, m) and changed, the rest as in :func:`lines_among`.
    """
    _, lines = lines_among(hinges, low, grain, face)
    for k in range(len(lines)):
        line = _line(lines[k])
        _hold(line, shown, face, grain[line.along])


@compiled
def _beside(line: Line, cells: BoolArray, inward: bool) -> BoolArray:
    """Cells on the side of the face of a line, or on the other, by place along it and distance from it; a view."""
    turned = cells if line.along == 0 else cells.T
    if line.above == inward:
        return turned[line.first : line.last, line.border :]
    return turned[line.first : line.last, line.border - 1 :: -1]


@compiled
def _hold(line: Line, shown: BoolArray, face: BoolArray, side: float) -> None:
    """Hold a line by what shows and what the face has; cells are `side` mm long along it."""
    cells, own = _beside(line, shown, True), _beside(line, face, True)
    count, far = cells.shape
    needed = ceil(_least_hold(float(count), HINGE_SHARE, HINGE_LENGTH / side))
    seam = max(round(NEAR_EDGE / side), 1)
    deep, aside = np.empty(count, np.int64), np.empty(count, np.int64)
    held = 0
    for k in range(count):
        deep[k] = _depth(cells[k], seam)
        held += deep[k] == 0
    if held >= needed:
        return
    _see_aside(deep, aside)
    for _ in range(needed):
        best = 0
        for k in range(1, count):
            if deep[k] < deep[best] or (deep[k] == deep[best] and aside[k] < aside[best]):
                best = k
        for step in range(min(deep[best], far)):
            cells[best, step] |= own[best, step]
        deep[best] = far + 1


@compiled
def _see_aside(deep: IntArray, aside: IntArray) -> None:
    """How many places each of some (n,) is from the nearest of least depth, into `aside`."""
    least, far = deep[0], len(deep)
    for k in range(1, len(deep)):
        least = min(least, deep[k])
    apart = far
    for k in range(len(deep)):
        apart = 0 if deep[k] == least else apart + 1
        aside[k] = apart
    apart = far
    for k in range(len(deep) - 1, -1, -1):
        apart = 0 if deep[k] == least else apart + 1
        aside[k] = min(aside[k], apart)


@compiled
def _depth(cells: BoolArray, seam: int) -> int:
    """How far from a line a place (depth,) shows more than a seam along it; its length where nothing."""
    for step in range(seam, len(cells)):
        if cells[step]:
            return 0 if step <= seam else step
    return 0 if cells[0] or len(cells) <= seam else len(cells)


@compiled
def overhangs(
    hinges: FloatArray, low: FloatArray, grain: FloatArray, face: BoolArray, shown: BoolArray
) -> tuple[IntArray, IntArray, IntArray]:
    """What shows beyond hinges of a face.

    Parameters
    ----------
    hinges, low, grain, face:
        As in :func:`lines_among`.
    shown:
        Cells that show something, shape (n, m).

    Returns
    -------
    tuple
        Places and fields of those lines that something touches beyond the face, as :func:`lines_among` has them,
        and how many cells show something beyond each place along each where something touches it, shape (l, k),
        k the greater of n and m.
    """
    places, lines = lines_among(hinges, low, grain, face)
    counts = np.zeros((len(lines), max(face.shape)), np.int64)
    found = 0
    for k in range(len(lines)):
        line = _line(lines[k])
        beyond, own = _beside(line, shown, False), _beside(line, face, False)
        touched = False
        for place in range(len(beyond)):
            if beyond[place, 0] and not own[place, 0]:
                touched = True
                for step in range(beyond.shape[1]):
                    counts[found, place] += beyond[place, step] and not own[place, step]
        if touched:
            places[found], lines[found] = places[k], lines[k]
            found += 1
    return places[:found], lines[:found], counts[:found]


@compiled
def cut_off(shown: BoolArray, face: BoolArray, line: Line) -> None:
    """Let nothing show beyond a line but in the face; `shown`, of shape (n, m) as the face, is changed."""
    beyond, own = _beside(line, shown, False), _beside(line, face, False)
    for place in range(len(beyond)):
        for step in range(beyond.shape[1]):
            beyond[place, step] &= own[place, step]


@compiled
def crossings(
    first: IntArray, second: IntArray, worth: float, other_worth: float, length: float, least: float
) -> IntArray:
    """Stretches of a hinge beyond which two plates both go on, and which of them shows less there.

    Parameters
    ----------
    first, second:
        How many cells of either show something beyond each place along it, as in :func:`overhangs`, shapes (n,)
        and (m,).
    worth, other_worth:
        What one of them counts.
    length:
        Of the hinge, mm.
    least:
        Shorter stretches give way, mm.

    Returns
    -------
    numpy.ndarray
        Which plate (0 or 1), the first of its places, and the one after the last, shape (k, 3).
    """
    count = max(len(first), len(second))
    found = np.empty((count // 2 + 1, 3), np.int64)
    stretches, start = 0, -1
    for k in range(count + 1):
        one, other = int((k + 0.5) * len(first) / count), int((k + 0.5) * len(second) / count)
        both = k < count and first[one] > 0 and second[other] > 0
        if both and start < 0:
            start = k
        if both or start < 0:
            continue
        if (k - start) * length / count > least:
            spans = np.empty((2, 2), np.int64)
            for plate, places in ((0, len(first)), (1, len(second))):
                spans[plate, 0] = int((start + 0.5) * places / count)
                spans[plate, 1] = int((k - 0.5) * places / count) + 1
            shown = worth * first[spans[0, 0] : spans[0, 1]].sum()
            also = other_worth * second[spans[1, 0] : spans[1, 1]].sum()
            plate = int(also < shown)
            found[stretches, 0], found[stretches, 1], found[stretches, 2] = plate, spans[plate, 0], spans[plate, 1]
            stretches += 1
        start = -1
    return found[:stretches]

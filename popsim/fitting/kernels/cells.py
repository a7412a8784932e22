"""Cells of a plane: which of them lie in a polygon, beside others, or hang together with others."""

from math import ceil, floor

import numpy as np

from popsim.fitting.kernels.compiled import compiled
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray

STRAIGHT = 1e-9
"""By how little, mm, edges of a rectangle leave the axes."""


@compiled
def divided(
    face: FloatArray, free: FloatArray, first: float, last: float, length: float, margin: int
) -> tuple[float, float, FloatArray]:
    """Cells of about one length over a face and what of its room lies in some bounds, along one axis.

    Parameters
    ----------
    face, free:
        Coordinates of the corners of both, mm, shapes (n,) and (k,).
    first, last:
        The bounds.
    length:
        Of a cell, mm; the face begins and ends with one.
    margin:
        Cells beyond all that.

    Returns
    -------
    tuple
        Where the cells start, how long they are, and their centres.
    """
    (least, most), (low, high) = span(face), span(free)
    side = (most - least) / max(round((most - least) / length), 1)
    start = floor((min(least, max(low, first)) - least) / side) - margin
    stop = ceil((max(most, min(high, last)) - least) / side) + margin
    centres = np.empty(stop - start)
    for k in range(stop - start):
        centres[k] = least + (start + k + 0.5) * side
    return least + start * side, side, centres


@compiled
def span(values: FloatArray) -> tuple[float, float]:
    """The least and the greatest of some values, shape (n,)."""
    low = high = values[0]
    for k in range(1, len(values)):
        low, high = min(low, values[k]), max(high, values[k])
    return low, high


@compiled
def within(s: FloatArray, t: FloatArray, ring: FloatArray) -> BoolArray:
    """Which points of a grid lie in a simple polygon.

    Parameters
    ----------
    s, t:
        Coordinates of the rows, ascending, and of the columns, shapes (n,) and (m,).
    ring:
        Corners, shape (k, 2).

    Returns
    -------
    numpy.ndarray
        Shape (n, m).
    """
    found = np.zeros((len(s), len(t)), np.bool_)
    count = len(ring)
    box = count == 4
    for k in range(count):
        across = abs(ring[k, 0] - ring[k - 1, 0])
        along = abs(ring[k, 1] - ring[k - 1, 1])
        box = box and min(across, along) < STRAIGHT
    if box:
        (left, right), (low, high) = span(ring[:, 0]), span(ring[:, 1])
        first = last = 0
        for j in range(len(t)):
            first += t[j] <= low
            last += t[j] < high
        for i in range(len(s)):
            if left < s[i] < right:
                found[i, first:last] = True
        return found
    ends = np.empty(count)
    for i in range(len(s)):
        crossed = 0
        for k in range(count):
            x0, x1 = ring[k - 1, 0], ring[k, 0]
            if (s[i] >= x0) != (s[i] >= x1):
                y0 = ring[k - 1, 1]
                end = y0 + (s[i] - x0) * ((ring[k, 1] - y0) / (x1 - x0))
                place = crossed
                while place > 0 and ends[place - 1] > end:
                    ends[place] = ends[place - 1]
                    place -= 1
                ends[place] = end
                crossed += 1
        j = 0
        for k in range(0, crossed, 2):
            while j < len(t) and t[j] < ends[k]:
                j += 1
            while j < len(t) and t[j] < ends[k + 1]:
                found[i, j] = True
                j += 1
    return found


@compiled
def extent(mask: BoolArray) -> tuple[int, int, int, int]:
    """First row in which a mask (n, m) holds anything, the one after the last, and the same of columns."""
    first, last, least, most = mask.shape[0], 0, mask.shape[1], 0
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            if mask[i, j]:
                first, last, least, most = min(first, i), i + 1, min(least, j), max(most, j + 1)
    return first, last, least, most


@compiled
def counted(mask: BoolArray) -> int:
    """How many cells a mask holds."""
    count = 0
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            count += mask[i, j]
    return count


@compiled
def grown(mask: BoolArray) -> BoolArray:
    """A mask (n, m) and the cells beside its cells."""
    rows, columns = mask.shape
    cells = mask.view(np.uint8)
    found = cells.copy()
    for i in range(rows):
        own, new = cells[i], found[i]
        for j in range(columns - 1):
            new[j] |= own[j + 1]
        for j in range(1, columns):
            new[j] |= own[j - 1]
    for i in range(rows - 1):
        low, high, new_low, new_high = cells[i], cells[i + 1], found[i], found[i + 1]
        for j in range(columns):
            new_low[j] |= high[j]
            new_high[j] |= low[j]
    return found.view(np.bool_)


@compiled
def grown_by(mask: BoolArray, steps: int) -> BoolArray:
    """The same some steps far."""
    for _ in range(steps):
        mask = grown(mask)
    return mask


@compiled
def square_around(mask: BoolArray, steps: int) -> BoolArray:
    """Cells at most some steps, of either index, from one of a mask, shape (n, m)."""
    rows, columns = mask.shape
    cells = mask.view(np.uint8)
    wide = cells.copy()
    for step in range(1, steps + 1):
        for i in range(rows):
            own, new = cells[i], wide[i]
            for j in range(columns - step):
                new[j] |= own[j + step]
            for j in range(step, columns):
                new[j] |= own[j - step]
    found = wide.copy()
    for step in range(1, steps + 1):
        for i in range(rows - step):
            new, high = found[i], wide[i + step]
            for j in range(columns):
                new[j] |= high[j]
        for i in range(step, rows):
            new, low = found[i], wide[i - step]
            for j in range(columns):
                new[j] |= low[j]
    return found.view(np.bool_)


@compiled
def reached(free: BoolArray, seeds: BoolArray) -> BoolArray:
    """Free cells that hang together, by their sides, with free seeds; all of shape (n, m).

    Runs of free cells in a row are joined to those of the row before that they touch.
    """
    rows, columns = free.shape
    most = rows * (columns // 2 + 1)
    row, begin, end = np.empty(most, np.int64), np.empty(most, np.int64), np.empty(most, np.int64)
    root = np.empty(most, np.int64)
    held = np.empty(most, np.bool_)
    count = before = 0
    for i in range(rows):
        start, j = count, 0
        while j < columns:
            if not free[i, j]:
                j += 1
                continue
            first, seeded = j, False
            while j < columns and free[i, j]:
                seeded |= seeds[i, j]
                j += 1
            row[count], begin[count], end[count], held[count], root[count] = i, first, j, seeded, count
            count += 1
        over = before
        for own in range(start, count):
            while over < start and end[over] <= begin[own]:
                over += 1
            other = over
            while other < start and begin[other] < end[own]:
                one, two = _top(root, own), _top(root, other)
                low, high = min(one, two), max(one, two)
                root[high] = low
                held[low] |= held[high]
                other += 1
        before = start
    found = np.zeros(free.shape, np.bool_)
    for own in range(count):
        if held[_top(root, own)]:
            for j in range(begin[own], end[own]):
                found[row[own], j] = True
    return found


@compiled
def _top(root: IntArray, run: int) -> int:
    """The run that stands for all that one is joined to."""
    while root[run] != run:
        root[run] = root[root[run]]
        run = root[run]
    return run

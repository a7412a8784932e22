"""Pictures of plates in views, put together and compared with the model.

Spans and depths of pictures are those of :class:`popsim.fitting.views.Picture`.
"""

import numpy as np

from popsim.fitting.kernels.cells import extent
from popsim.fitting.kernels.compiled import compiled, summing
from popsim.fitting.kernels.records import Facing, FloatImage
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray

FINE = np.float32(1 << 16)
"""Parts in which differences of depths are summed: whole numbers add up to the same in any order, as long as those
of a row, of at most 255 pixels, stay exact."""


@compiled
def drawn(
    mask: BoolArray, low: FloatArray, grain: FloatArray, level: float, facing: Facing, pixels: int
) -> tuple[IntArray, FloatImage]:
    """Draw what shows in a plane into all views that see it.

    Parameters
    ----------
    mask:
        Cells of the plane that show something, shape (n, m).
    low, grain:
        Corner where the cells start, and their sides, mm, each of shape (2,).
    level:
        Of the plane.
    facing:
        How the views see planes of its slope.
    pixels:
        Of a row of a view.
    """
    first, last, least, most = extent(mask)
    s0, s1 = low[0] + first * grain[0], low[0] + last * grain[0]
    t0, t1 = low[1] + least * grain[1], low[1] + most * grain[1]
    spans = np.empty((len(facing.views) if first < last else 0, 5), np.int64)
    size = 0
    for k in range(len(spans)):
        ends = np.empty((2, 2), np.int64)
        for axis in range(2):
            turn_s, turn_t = facing.turn[k, axis, 0], facing.turn[k, axis, 1]
            middle = turn_s * (s0 + s1) / 2 + turn_t * (t0 + t1) / 2
            middle += facing.origin[k, axis] + level * facing.rise[k, axis]
            half = abs(turn_s) * (s1 - s0) / 2 + abs(turn_t) * (t1 - t0) / 2
            ends[axis, 0] = min(max(round(middle - half), 0), pixels)
            ends[axis, 1] = min(max(round(middle + half), 0), pixels)
        spans[k, 0], spans[k, 1], spans[k, 2] = facing.views[k], ends[1, 0], ends[1, 1]
        spans[k, 3], spans[k, 4] = ends[0, 0], ends[0, 1]
        size += (ends[1, 1] - ends[1, 0]) * (ends[0, 1] - ends[0, 0])
    depth = np.empty(size, np.float32)
    place = 0
    for k in range(len(spans)):
        own = (spans[k, 2] - spans[k, 1]) * (spans[k, 4] - spans[k, 3])
        _draw(mask, low, grain, level, facing, k, spans[k], depth[place : place + own])
        place += own
    return spans, depth


@compiled
def _draw(
    mask: BoolArray,
    low: FloatArray,
    grain: FloatArray,
    level: float,
    facing: Facing,
    k: int,
    span: IntArray,
    depth: FloatImage,
) -> None:
    """Fill one rectangle, row after row."""
    across = facing.origin[k, 0] + level * facing.rise[k, 0]
    up = facing.origin[k, 1] + level * facing.rise[k, 1]
    near = facing.depth[k] - level * facing.height[k]
    s_across, s_up = facing.back[k, 0, 0] / grain[0], facing.back[k, 0, 1] / grain[0]
    t_across, t_up = facing.back[k, 1, 0] / grain[1], facing.back[k, 1, 1] / grain[1]
    s0, t0 = low[0] / grain[0], low[1] / grain[1]
    rows, columns = float(mask.shape[0]), float(mask.shape[1])
    deepening, place = facing.deepening[k, 0], 0
    for row in range(span[1], span[2]):
        y = row + 0.5 - up
        s_row, t_row, deeper = s_up * y, t_up * y, facing.deepening[k, 1] * y
        for column in range(span[3], span[4]):
            x = column + 0.5 - across
            i, j = s_across * x + s_row - s0, t_across * x + t_row - t0
            depth[place] = np.inf
            if 0 <= i < rows and 0 <= j < columns and mask[int(i), int(j)]:
                depth[place] = near + deepening * x + deeper
            place += 1


@compiled
def paint(image: FloatImage, spans: IntArray, depth: FloatImage) -> None:
    """Put a picture into views (v, n, n), where it is nearer than what is there."""
    place = 0
    for k in range(len(spans)):
        width = spans[k, 4] - spans[k, 3]
        for row in range(spans[k, 1], spans[k, 2]):
            there, own = image[spans[k, 0], row, spans[k, 3] : spans[k, 4]], depth[place : place + width]
            for column in range(width):
                there[column] = own[column] if own[column] < there[column] else there[column]
            place += width


@compiled
def mirrored(spans: IntArray, depth: FloatImage, others: IntArray, pixels: int) -> tuple[IntArray, FloatImage]:
    """The picture of the mirror image; `others` are the views that see it, left and right exchanged, (v,)."""
    found, line = spans.copy(), np.empty(len(depth), np.float32)
    place = 0
    for k in range(len(spans)):
        found[k, 0] = others[spans[k, 0]]
        found[k, 3], found[k, 4] = pixels - spans[k, 4], pixels - spans[k, 3]
        width = spans[k, 4] - spans[k, 3]
        for _ in range(spans[k, 1], spans[k, 2]):
            for column in range(width):
                line[place + column] = depth[place + width - 1 - column]
            place += width
    return found, line


@compiled
def both_sides(near: FloatImage, views: IntArray, others: IntArray, found: FloatImage) -> None:
    """Some views of what is on both sides of the fold, (k, n, n), from all views (v, n, n) of one side."""
    pixels = near.shape[1]
    for k in range(len(views)):
        for row in range(pixels):
            one, other, line = near[views[k], row], near[others[views[k]], row], found[k, row]
            for column in range(pixels):
                line[column] = min(one[column], other[pixels - 1 - column])


@compiled
def compared(depth: FloatImage, model: FloatImage, deep: float) -> FloatArray:
    """Compare views with those of the model, both of shape (v, n, n).

    Returns
    -------
    numpy.ndarray
        For each view in how many pixels either shows something, in how many both do, in how many at depths that
        differ by at most `deep`, and the sum of the differences, each at most `deep`, over `deep`; shape (v, 4).
    """
    found = np.zeros((len(depth), 4))
    scale = np.float32(1 / deep)
    for view in range(len(depth)):
        for row in range(depth.shape[1]):
            _compare(depth[view, row], model[view, row], scale, found[view])
    found[:, 3] /= FINE
    return found


@summing
def _compare(own: FloatImage, other: FloatImage, scale: np.float32, found: FloatArray) -> None:
    """Add what a row of a view tells beside that of the model, in whole numbers below 2^24."""
    one, none, far = np.float32(1), np.float32(0), np.float32(np.inf)
    either = both = same = apart = none
    for column in range(len(own)):
        off = abs(own[column] - other[column]) * scale  # no number where neither shows anything
        nearest = own[column] if own[column] < other[column] else other[column]
        either += one if nearest < far else none
        both += one if off < far else none
        same += one if off <= one else none
        apart += np.floor((off if off < one else one) * FINE) if off < far else none
    found[0] += either
    found[1] += both
    found[2] += same
    found[3] += apart

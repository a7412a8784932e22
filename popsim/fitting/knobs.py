"""The borders of a primitive as numbers: what snapping and refitting turn."""

from collections.abc import Sequence
from itertools import pairwise

from popsim.mechanisms import BasePatchPair, PairKind, Primitive, PrismRow, RectangularPrism, TriangularPrism

Knob = tuple[int, float]
"""Axis (0 x, 1 distance from the bisecting plane, 2 height) and position in the card frame, mm."""

SAME = 1e-6
"""mm; tops whose heights differ by less are one."""


def knobs(primitive: Primitive) -> tuple[Knob, ...]:
    """The borders that may move; those on the base patch pair do not."""
    if isinstance(primitive, PrismRow):
        tops = primitive.tops
        borders = [tops[0][0], *(x1 for _, x1, _ in tops)]
        heights = [primitive.base + height for _, _, height in tops]
        return ((1, primitive.half_width), *((0, x) for x in borders), *((2, z) for z in heights))
    far = max(abs(primitive.low[1]), abs(primitive.high[1]))
    return ((0, primitive.low[0]), (0, primitive.high[0]), (1, far), (2, primitive.high[2]))


def turned(primitive: Primitive, values: Sequence[float]) -> Primitive:
    """The primitive with its knobs at `values`.

    Raises
    ------
    GeometryError
        Nothing is left of it.
    """
    if isinstance(primitive, PrismRow):
        count = len(primitive.tops)
        borders, heights = values[1 : count + 2], values[count + 2 :]
        tops = [(borders[k], borders[k + 1], heights[k] - primitive.base) for k in range(count)]
        return PrismRow(values[0], primitive.base, merged(tops))
    x0, x1, far, z1 = values
    z0 = primitive.low[2]
    if isinstance(primitive, TriangularPrism):
        return TriangularPrism((x0, -far, z0), (x1, far, z1), primitive.edges, primitive.facing)
    if primitive.turned:
        half, middle = min(far, (x1 - x0) / 2), (x0 + x1) / 2
        return RectangularPrism((middle - half, -half, z0), (middle + half, half, z1), turned=True)
    sign = 1.0 if primitive.high[1] + primitive.low[1] > 0 else -1.0
    near = min(abs(primitive.low[1]), abs(primitive.high[1]))
    y0, y1 = sorted((sign * near, sign * far))
    return RectangularPrism((x0, y0, z0), (x1, y1, z1), primitive.turned)


def thinnest(primitive: Primitive) -> float:
    """The least extent of a primitive, or of a step between two prisms of a row, mm."""
    if isinstance(primitive, PrismRow):
        heights = [height for _, _, height in primitive.tops]
        lengths = [x1 - x0 for x0, x1, _ in primitive.tops]
        steps = [abs(b - a) for a, b in pairwise(heights)]
        return min(2 * primitive.half_width, *lengths, *heights, *steps)
    return min(high - low for low, high in zip(primitive.low, primitive.high, strict=True))


def simplified(primitive: Primitive, least: float) -> Primitive:
    """The primitive without what is thinner than `least` mm in a row.

    Tops shorter, and steps lower, join a neighbour; then ends lower than that go.
    """
    if not isinstance(primitive, PrismRow):
        return primitive
    tops = list(primitive.tops)
    while len(tops) > 1:
        lengths = [x1 - x0 for x0, x1, _ in tops]
        short = min(range(len(tops)), key=lengths.__getitem__)
        steps = [abs(right[2] - left[2]) for left, right in pairwise(tops)]
        low = min(range(len(steps)), key=steps.__getitem__)
        if lengths[short] < least:
            sides = [k for k in (short - 1, short) if 0 <= k < len(steps)]
            low = min(sides, key=steps.__getitem__)
        elif steps[low] >= least:
            break
        left, right = tops[low], tops[low + 1]
        longer = left if left[1] - left[0] >= right[1] - right[0] else right
        tops[low : low + 2] = [(left[0], right[1], longer[2])]
    while len(tops) > 1 and tops[0][2] < least:
        tops.pop(0)
    while len(tops) > 1 and tops[-1][2] < least:
        tops.pop()
    return PrismRow(primitive.half_width, primitive.base, merged(tops))


def limited(knob: Knob, pair: BasePatchPair) -> float:
    """The position of a knob, kept where the pair ends."""
    axis, value = knob
    opening = pair.kind is PairKind.OPENING
    if axis == 0:
        return min(max(value, pair.x[0]), pair.x[1])
    if axis == 1:
        return min(value, min(pair.reach) if opening else pair.u + pair.reach[0])
    return value if opening else min(value, pair.v + pair.reach[1])


def merged(tops: Sequence[tuple[float, float, float]]) -> tuple[tuple[float, float, float], ...]:
    """Tops of a row without the empty ones, neighbours of one height joined."""
    found: list[tuple[float, float, float]] = []
    for x0, x1, height in tops:
        if x1 - x0 < SAME:
            continue
        start = found[-1][1] if found else x0
        if found and abs(found[-1][2] - height) < SAME:
            found[-1] = (found[-1][0], x1, height)
        else:
            found.append((start, x1, height))
    return tuple(found)


def settled(primitive: Primitive, old: BasePatchPair, new: BasePatchPair) -> Primitive:
    """The primitive moved from one pair to another of the same kind and side, and kept within it.

    Raises
    ------
    GeometryError
        Nothing of it is left there.
    """
    rise, out = new.v - old.v, new.u - old.u
    if isinstance(primitive, PrismRow):
        moved: Primitive = PrismRow(primitive.half_width, primitive.base + rise, primitive.tops)
    else:
        (x0, y0, z0), (x1, y1, z1) = primitive.low, primitive.high
        shift = 0.0 if new.kind is PairKind.OPENING else new.side.value * out
        low, high = (x0, y0 + shift, z0 + rise), (x1, y1 + shift, z1 + rise)
        if isinstance(primitive, TriangularPrism):
            moved = TriangularPrism(low, high, primitive.edges, primitive.facing)
        else:
            moved = RectangularPrism(low, high, primitive.turned)
    return turned(moved, [limited(knob, new) for knob in knobs(moved)])

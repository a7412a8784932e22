"""What covering each cell of the volume would gain."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.fitting.volume import Volume
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.frame import Side
from popsim.mechanisms import BasePatchPair, PairKind, Primitive, PrismRow, RectangularPrism, TriangularPrism

BLOCKED = -1e4
"""Price of a cell that another prism holds: too high to be paid."""


class Field:
    """Gain per cell, changing as prisms are placed: solid 1, empty -`empty`, held by a prism BLOCKED."""

    def __init__(self, volume: Volume, empty: float) -> None:
        self.volume = volume
        self.gain: FloatArray = np.where(volume.solid, 1.0, -empty)
        self.solid_cells = int(volume.solid.sum())

    def cover(self, primitive: Primitive) -> None:
        """Give the cells of a placed primitive away."""
        boxes = primitive.prisms() if isinstance(primitive, PrismRow) else (primitive,)
        for prism in boxes:
            for half, sign in enumerate((1, -1)):
                near, far = sorted((sign * prism.low[1], sign * prism.high[1]))
                low = np.array([prism.low[0], max(0.0, near), prism.low[2]])
                (a, b), (c, d), (e, f) = self.cells(low, np.array([prism.high[0], far, prism.high[2]]))
                block = self.gain[half, a:b, c:d, e:f]
                if block.size:
                    block[self._within(prism, (a, b), (c, d), (e, f))] = BLOCKED

    def bar(self, bounds: FloatArray) -> None:
        """Let nothing cover a cell that reaches into a box, rows low and high, card frame, mm, shape (2, 3)."""
        grown = bounds + np.array([[-0.5], [0.5]]) * self.volume.cell
        for half, sign in enumerate((1, -1)):
            near, far = sorted(sign * grown[:, 1])
            low = np.array([grown[0, 0], max(0.0, near), grown[0, 2]])
            (a, b), (c, d), (e, f) = self.cells(low, np.array([grown[1, 0], far, grown[1, 2]]))
            self.gain[half, a:b, c:d, e:f] = BLOCKED

    def _within(self, prism: Primitive, *ranges: tuple[int, int]) -> BoolArray:
        """Which cells of a block lie in a prism, by their centres."""
        x, u, z = np.meshgrid(*(np.arange(*r) + 0.5 for r in ranges), indexing="ij")
        cell = self.volume.cell
        if isinstance(prism, RectangularPrism) and prism.turned:
            middle = (prism.low[0] + prism.high[0]) / 2
            return np.asarray(np.abs(self.volume.x0 + x * cell - middle) + u * cell <= prism.high[1])
        if not isinstance(prism, TriangularPrism):
            return np.ones(x.shape, dtype=bool)
        half = prism.high[1]
        if prism.edges == "x":
            share = (z * cell - prism.low[2]) / (prism.high[2] - prism.low[2])
        else:
            tip, end = (prism.high[0], prism.low[0]) if prism.facing == 1 else (prism.low[0], prism.high[0])
            share = (self.volume.x0 + x * cell - end) / (tip - end)
        return np.asarray(u * cell <= half * (1 - share))

    def cells(self, low: FloatArray, high: FloatArray) -> tuple[tuple[int, int], ...]:
        """Index ranges along x, u, z of the cells whose centres lie in a box (x, u, v), mm."""
        origin = np.array([self.volume.x0, 0.0, 0.0])
        first = np.ceil((np.asarray(low) - origin) / self.volume.cell - 0.5).astype(int)
        last = np.ceil((np.asarray(high) - origin) / self.volume.cell - 0.5).astype(int)
        limits = self.volume.shape
        return tuple(
            (int(np.clip(a, 0, n)), int(np.clip(max(a, b), 0, n)))
            for a, b, n in zip(first, last, limits, strict=True)
        )


@dataclass(frozen=True, eq=False)
class Spot:
    """A base patch pair and the part of the field that lies over it.

    Attributes
    ----------
    pair:
        The pair.
    gain:
        Over the pair: (x, u, z) from the fold line on, both halves added on opening pairs.
    start:
        Card position of the first cell border: x, u, v, mm.
    cell:
        Edge of a cell, mm.
    """

    pair: BasePatchPair
    gain: FloatArray
    start: FloatArray
    cell: float

    def place(self, *index: float) -> FloatArray:
        """Card position (x, u, v) of a cell border (x, u, z), mm."""
        return np.asarray(self.start + np.array(index) * self.cell)

    @cached_property
    def summed(self) -> FloatArray:
        """Gain of covering, in each column x, the first w cells along u and the first h along z: (x, w, h)."""
        sums = np.zeros((self.gain.shape[0], self.gain.shape[1] + 1, self.gain.shape[2] + 1))
        sums[:, 1:, 1:] = self.gain.cumsum(axis=1).cumsum(axis=2)
        return sums


def spot_on(field: Field, pair: BasePatchPair) -> Spot | None:
    """The field over a pair, or None where it has no cells.

    Beside a wall it begins with the first whole cell: what a wall leaves of a cell is the skin of the same thing.
    """
    volume = field.volume
    reach = min(pair.reach) if pair.kind is PairKind.OPENING else pair.reach[0]
    top = np.inf if pair.kind is PairKind.OPENING else pair.v + pair.reach[1]
    ends = np.array([volume.x(volume.shape[0]), volume.shape[1] * volume.cell, volume.shape[2] * volume.cell])
    skin = 0.5 * volume.cell if pair.kind is PairKind.CORNER else 0.0
    low = np.array([max(pair.x[0], volume.x0), pair.u + skin, pair.v])
    high = np.minimum([pair.x[1], pair.u + reach, top], ends)
    (a, b), (c, d), (e, f) = field.cells(low, high)
    if a == b or c == d or e == f:
        return None
    halves = [0, 1] if pair.kind is PairKind.OPENING else [0 if pair.side is Side.GROUND else 1]
    gain = field.gain[halves, a:b, c:d, e:f].sum(axis=0)
    start = np.array([volume.x(a), c * volume.cell, e * volume.cell])
    return Spot(pair, gain, start, volume.cell)

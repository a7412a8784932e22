"""Hinges among the cells of a stencil."""

from collections.abc import Iterator
from typing import NamedTuple

from popsim.geometry.arrays import BoolArray, FloatArray

STRAIGHT = 1e-6
"""mm; hinges that leave the rows and columns of the cells by more are left alone."""


class Line(NamedTuple):
    """A stretch of a hinge along an edge of a face, between two rows or columns of cells.

    Attributes
    ----------
    along:
        The axis of the cells that runs along it.
    first, last:
        Its first cell along that axis, and the one after its last.
    border:
        Cells of the other axis that lie below it.
    above:
        Whether the face lies above it.
    """

    along: int
    first: int
    last: int
    border: int
    above: bool

    def inward(self, cells: BoolArray) -> BoolArray:
        """Cells on the side of the face, by place along the line and distance from it; a view."""
        return self._beside(cells, above=self.above)

    def beyond(self, cells: BoolArray) -> BoolArray:
        """The same on the other side."""
        return self._beside(cells, above=not self.above)

    def _beside(self, cells: BoolArray, *, above: bool) -> BoolArray:
        turned = cells if self.along == 0 else cells.T
        return turned[
            self.first : self.last, slice(self.border, None) if above else slice(self.border - 1, None, -1)
        ]


def lines_among(
    hinges: FloatArray, low: FloatArray, grain: FloatArray, face: BoolArray
) -> Iterator[tuple[int, Line]]:
    """Those of some hinges that run along an edge of a face and along its cells, each with its place among them.

    Parameters
    ----------
    hinges:
        Their ends in the coordinates of the cells, mm, shape (k, 2, 2).
    low, grain:
        Corner where the cells start and their sides, mm, each of shape (2,).
    face:
        Cells in the face, shape (n, m).
    """
    for place, ((s0, t0), (s1, t1)) in enumerate(((hinges - low) / grain).tolist()):
        if abs(t1 - t0) * grain[1] < STRAIGHT:
            along, span, border, cells = 0, (s0, s1), round(t0), face
        elif abs(s1 - s0) * grain[0] < STRAIGHT:
            along, span, border, cells = 1, (t0, t1), round(s0), face.T
        else:
            continue
        first, last = max(round(min(span)), 0), round(max(span))
        if last <= first or not 0 < border < cells.shape[1]:
            continue
        middle = (first + last) // 2
        above, below = bool(cells[middle, border]), bool(cells[middle, border - 1])
        if above != below:
            yield place, Line(along, first, last, border, above)

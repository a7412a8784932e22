"""Hinges among the cells of a stencil."""

from typing import NamedTuple

from popsim.geometry.arrays import BoolArray


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

    def beyond(self, cells: BoolArray) -> BoolArray:
        """Cells on the side where the face is not, by place along the line and distance from it; a view."""
        turned = cells if self.along == 0 else cells.T
        away = slice(self.border - 1, None, -1) if self.above else slice(self.border, None)
        return turned[self.first : self.last, away]

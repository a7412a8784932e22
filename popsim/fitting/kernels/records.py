"""What compiled functions take and give; without Numba."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray

FloatImage = npt.NDArray[np.float32]


class Ends(NamedTuple):
    """How far out a model reaches along one axis, as a plate sees it (:class:`popsim.fitting.fronts.Fronts`).

    Attributes
    ----------
    bounds:
        The box in which it is looked at, along the other two axes, rows low and high, mm, shape (2, 2).
    start:
        Where the pixels begin, mm, shape (2,).
    pixel:
        Side of a pixel, mm.
    near, far:
        Reach towards the side that the plate faces, and towards the other one, mm, shape (r, c).
    sign:
        1 where the plate faces the high end of the axis, else -1.
    """

    bounds: FloatArray
    start: FloatArray
    pixel: float
    near: FloatArray
    far: FloatArray
    sign: int


class Seen(NamedTuple):
    """A plate in the coordinates s and t of its slant (:class:`popsim.fitting.slant.Slant`), mm.

    Attributes
    ----------
    outline, room:
        Its face and the room of its contours, shapes (n, 2) and (k, 2).
    hinges:
        Ends of its hinges, shape (l, 2, 2).
    taken:
        What others take of the room of a plate along the fold: between two s all from some t on, shape (m, 3).
    behind, beside:
        How deep behind its face, and in its room beyond, the model shows on it.
    principal:
        Of others the face shows what both sides hide.
    """

    outline: FloatArray
    room: FloatArray
    hinges: FloatArray
    taken: FloatArray
    behind: float
    beside: float
    principal: bool


class Held(NamedTuple):
    """A plate held against a model, by cells of its plane.

    Attributes
    ----------
    low, grain:
        Corner where the cells start, and their sides, mm, each of shape (2,).
    s, t:
        Centres of their rows (n,) and columns (m,), mm.
    inside:
        Cells of the face, here and below of shape (n, m).
    face, beyond:
        Where the model is near enough to show, in the face and in the room beyond it.
    there:
        Cells of the face with any of the model behind them.
    behind:
        How deep the model lies, mm; inf where there is none.
    deepest:
        The greatest of these where it shows, mm; -inf where it shows nowhere.
    """

    low: FloatArray
    grain: FloatArray
    s: FloatArray
    t: FloatArray
    inside: BoolArray
    face: BoolArray
    beyond: BoolArray
    there: BoolArray
    behind: FloatArray
    deepest: float


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


class Facing(NamedTuple):
    """How views see the planes of one slope, by the coordinates s and t of a slant.

    Attributes
    ----------
    views:
        Those that do not see them edge on, shape (v,).
    turn, origin, rise:
        The column and row of a point are ``turn @ (s, t) + origin + level * rise``; shapes (v, 2, 2), (v, 2) and
        (v, 2).
    back:
        Inverse of `turn`, shape (v, 2, 2).
    depth, height, deepening:
        A point is ``depth - level * height + deepening @ (pixel - origin - level * rise)`` from the origin of its
        ray, mm; shapes (v,), (v,), (v, 2).
    """

    views: IntArray
    turn: FloatArray
    origin: FloatArray
    rise: FloatArray
    back: FloatArray
    depth: FloatArray
    height: FloatArray
    deepening: FloatArray

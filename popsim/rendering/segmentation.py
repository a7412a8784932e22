"""Layers of a view: depth and normal maps cut where they leave their own quadratic course (Sec. 4.3, Eq. 3).

Of each pixel p and the pixels before it in its row and in its column, Eq. 3 continues every map f (the depth, and
the three components of the normal) by q(p) = f(p0) + f'(p0) (p - p0) + 1/2 f''(p0) (p - p0)^2. With derivatives
from the last three pixels, one pixel apart, that is q = 3 f(p0) - 3 f(p0 - 1) + f(p0 - 2). Pixels at which
f - q is beyond a threshold lie on a border; what is left falls into connected segments, and the border pixels are
given to the nearest of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.rendering.maps import OrthographicMaps

LABELS = np.int32
OUTSIDE = 0
"""Label of pixels that see nothing."""

BORDER = 3
"""Pixels; Eq. 3 with derivatives from three pixels marks as many behind an edge."""

Image = npt.NDArray[np.float32]
Course = tuple[npt.NDArray[np.float32] | FloatArray, float]
"""A map and the amount by which a pixel may leave its course."""


@dataclass(frozen=True, eq=False)
class Segment:
    """A part of a view that is one smooth surface.

    Small parts that were given to it count for its area alone.

    Attributes
    ----------
    label:
        Its number in the label map, from 1 on.
    area:
        In the view, in units of length squared.
    depth:
        Median distance from the plane of the view.
    nearest, farthest:
        Least and greatest of these distances, of all but a hundredth of the pixels on each side.
    low, high:
        Extent in plane coordinates of the view, shape (2,) each.
    normal:
        Mean unit normal, in the frame of the surface, shape (3,).
    """

    label: int
    area: float
    depth: float
    nearest: float
    farthest: float
    low: FloatArray
    high: FloatArray
    normal: FloatArray


@dataclass(frozen=True, eq=False)
class Segmentation:
    """The segments of a view, the largest first, and which pixel belongs to which (0: nothing is seen)."""

    labels: npt.NDArray[np.int32]
    segments: tuple[Segment, ...]


def segment(
    maps: OrthographicMaps, *, step: float = 1.0, turn: float = 0.25, least_area: float = 4.0
) -> Segmentation:
    """Cut a view into layers.

    Parameters
    ----------
    maps:
        Depth and normals.
    step:
        Depth by which a pixel may leave the course of those before it, in units of length.
    turn:
        The same for each component of the unit normal.
    least_area:
        Smaller segments are given to their neighbours, in units of length squared.

    Raises
    ------
    GeometryError
        A threshold is not positive.
    """
    if not (step > 0 and turn > 0 and least_area >= 0):
        raise GeometryError(f"segmentation needs positive thresholds, not {step:g}, {turn:g} and {least_area:g}")
    courses: list[Course] = [(maps.depth, step), *((maps.normal[..., k], turn) for k in range(3))]
    own, border = _smooth(maps.mask, courses, least_area / maps.view.pixel**2)
    labels = _spread(own, maps.mask)
    edged = _spread(own, border | (own != OUTSIDE), 2 * BORDER)
    return Segmentation(labels, _described(maps, own, edged, labels))


def label_map(mask: BoolArray, courses: Sequence[Course], least: float) -> npt.NDArray[np.int32]:
    """Number of the segment of each pixel, shape (h, w).

    Parameters
    ----------
    mask:
        Pixels that see something, shape (h, w); the others get 0.
    courses:
        Maps of shape (h, w) and their thresholds.
    least:
        Segments of fewer pixels are given to their neighbours.
    """
    return _spread(_smooth(mask, courses, least)[0], mask)


def _smooth(mask: BoolArray, courses: Sequence[Course], least: float) -> tuple[npt.NDArray[np.int32], BoolArray]:
    """Number of the segment of each pixel amid one, 0 at borders and in small ones; and where borders are."""
    from scipy.ndimage import label

    border = ~mask
    for course, limit in courses:
        _mark(border, np.where(mask, course, 0).astype(np.float32), mask, np.float32(limit))
    labels, parts = label(~border, output=LABELS)
    sizes = np.bincount(labels.ravel(), minlength=parts + 1)
    sizes[OUTSIDE] = 0
    order = np.argsort(-sizes, kind="stable")
    number = np.zeros(parts + 1, dtype=LABELS)
    kept = order[: int((sizes >= max(least, 1)).sum())]
    number[kept] = np.arange(1, len(kept) + 1)
    return number[labels], border & mask


def _mark(border: BoolArray, f: Image, mask: BoolArray, limit: np.float32) -> None:
    """Mark the pixels at which `f` leaves its quadratic course along rows or columns."""
    for axis in (0, 1):
        here, one, two, three = (_back(axis, count) for count in range(4))
        off = f[one] - f[two]
        off *= np.float32(-3)
        off += f[here]
        off -= f[three]
        np.abs(off, out=off)
        border[here] |= (off > limit) & mask[one] & mask[two] & mask[three]


def _back(axis: int, count: int) -> tuple[slice, slice]:
    """The pixels `count` before those that have three before them, along an axis."""
    run = slice(3 - count, -count or None)
    return (run, slice(None)) if axis == 0 else (slice(None), run)


def _spread(labels: npt.NDArray[np.int32], mask: BoolArray, most: int | None = None) -> npt.NDArray[np.int32]:
    """`labels` with the pixels of the mask that have none given to their neighbours, nearest first.

    Borders lie just behind an edge in reading order, so that they are given to what is to their right or below
    where that is near. `most` bounds by how many pixels a segment grows.
    """
    rows, columns = labels.shape
    padded = np.zeros((rows + 2, columns + 2), dtype=LABELS)
    padded[1:-1, 1:-1] = labels
    flat = padded.ravel()
    row, column = np.nonzero(mask & (labels == OUTSIDE))
    left = (row + 1) * (columns + 2) + column + 1
    behind = (1, columns + 2)
    for step in count():
        near = behind if step < BORDER else (*behind, -1, -columns - 2)
        found = np.zeros(len(left), dtype=LABELS)
        for neighbour in near:
            np.copyto(found, flat[left + neighbour], where=found == OUTSIDE)
        flat[left] = found
        if (step >= BORDER and not found.any()) or step + 1 == most:
            break
        left = left[found == OUTSIDE]
    return padded[1:-1, 1:-1].copy()


def _described(
    maps: OrthographicMaps,
    own: npt.NDArray[np.int32],
    edged: npt.NDArray[np.int32],
    labels: npt.NDArray[np.int32],
) -> tuple[Segment, ...]:
    """The segments: `own` are the pixels amid them, `edged` those with their borders, `labels` all."""
    from scipy.ndimage import find_objects

    areas = np.bincount(labels.ravel()) * maps.view.pixel**2
    found = []
    for number, window in enumerate(find_objects(edged), 1):
        here = own[window] == number
        nearest, middle, farthest = np.percentile(maps.depth[window][here], [1, 50, 99])
        rows, columns = window
        low = maps.view.from_pixel(np.array([columns.start, rows.stop]))
        high = maps.view.from_pixel(np.array([columns.stop, rows.start]))
        normal = maps.normal[window][here].mean(axis=0, dtype=np.float64)
        length = float(np.linalg.norm(normal))
        unit = normal / length if length > 0 else maps.view.eye
        found.append(
            Segment(number, float(areas[number]), float(middle), float(nearest), float(farthest), low, high, unit)
        )
    return tuple(sorted(found, key=lambda one: -one.area))

"""Layers of a view: depth and normal maps cut where they leave their own quadratic course (Sec. 4.3, Eq. 3).

Of each pixel p and the pixels before it in its row and in its column, Eq. 3 continues every map f (the depth, and
the three components of the normal) by q(p) = f(p0) + f'(p0) (p - p0) + 1/2 f''(p0) (p - p0)^2. With derivatives
from the last three pixels, one pixel apart, that is q = 3 f(p0) - 3 f(p0 - 1) + f(p0 - 2). Pixels at which
f - q is beyond a threshold lie on a border; what is left falls into connected segments, and the border pixels are
given to the nearest of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.rendering.maps import OrthographicMaps

LABELS = np.int32
OUTSIDE = 0
"""Label of pixels that see nothing."""

Image = npt.NDArray[np.float32]
Course = tuple[npt.NDArray[np.float32] | FloatArray, float]
"""A map and the amount by which a pixel may leave its course."""


@dataclass(frozen=True, eq=False)
class Segment:
    """A part of a view that is one smooth surface.

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
    labels = label_map(maps.mask, courses, least_area / maps.view.pixel**2)
    return Segmentation(labels, _described(maps, labels))


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
    from scipy.ndimage import label

    border = ~mask
    for course, limit in courses:
        _mark(border, np.where(mask, course, 0).astype(np.float32), mask, np.float32(limit))
    labels, count = label(~border, output=LABELS)
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    sizes[OUTSIDE] = 0
    order = np.argsort(-sizes, kind="stable")
    number = np.zeros(count + 1, dtype=LABELS)
    kept = order[: int((sizes >= max(least, 1)).sum())]
    number[kept] = np.arange(1, len(kept) + 1)
    return _spread(number[labels], mask)


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


def _spread(labels: npt.NDArray[np.int32], mask: BoolArray) -> npt.NDArray[np.int32]:
    """`labels` with the pixels of the mask that have none given to their neighbours, nearest first.

    Borders lie just behind an edge in reading order, so the neighbours to the right and below are asked first.
    """
    rows, columns = labels.shape
    padded = np.zeros((rows + 2, columns + 2), dtype=LABELS)
    padded[1:-1, 1:-1] = labels
    flat = padded.ravel()
    row, column = np.nonzero(mask & (labels == OUTSIDE))
    left = (row + 1) * (columns + 2) + column + 1
    while len(left):
        found = np.zeros(len(left), dtype=LABELS)
        for neighbour in (1, columns + 2, -1, -columns - 2):
            np.copyto(found, flat[left + neighbour], where=found == OUTSIDE)
        flat[left] = found
        if not found.any():
            break
        left = left[found == OUTSIDE]
    return padded[1:-1, 1:-1].copy()


def _described(maps: OrthographicMaps, labels: npt.NDArray[np.int32]) -> tuple[Segment, ...]:
    from scipy.ndimage import find_objects

    found = []
    for number, window in enumerate(find_objects(labels), 1):
        if window is None:
            continue
        here = labels[window] == number
        depths = maps.depth[window][here]
        nearest, middle, farthest = np.percentile(depths, [1, 50, 99])
        rows, columns = window
        low = maps.view.from_pixel(np.array([columns.start, rows.stop]))
        high = maps.view.from_pixel(np.array([columns.stop, rows.start]))
        normal = maps.normal[window][here].mean(axis=0, dtype=np.float64)
        length = float(np.linalg.norm(normal))
        area = float(here.sum()) * maps.view.pixel**2
        unit = normal / length if length > 0 else maps.view.eye
        found.append(Segment(number, area, float(middle), float(nearest), float(farthest), low, high, unit))
    return tuple(sorted(found, key=lambda one: -one.area))

"""Feature lines of a picture: outlines, steps in depth, and creases."""

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray

Image = npt.NDArray[np.float32]

CREASE = float(np.cos(np.radians(30.0)))  # neighbours whose normals turn by more are on a crease
STEP = 3.0  # pixels: a neighbour that leaves the tangent plane by more is on another surface


def feature_edges(
    mask: BoolArray, normal: Image, point: Image, pixel: Image | float, width: int, *, outlines: bool = True
) -> BoolArray:
    """Return the pixels (h, w) on which a feature line is drawn; always within `mask`.

    Parameters
    ----------
    mask:
        Where a surface is seen, shape (h, w).
    normal:
        Unit normals that point to the viewer, shape (h, w, 3).
    point:
        The points in space that are seen, shape (h, w, 3); finite everywhere.
    pixel:
        Side of a pixel at these points, in the unit of the points, shape (h, w) or a number.
    width:
        Width of the lines in pixels.
    outlines:
        Whether to draw the border of the mask too.
    """
    lines = np.zeros_like(mask)
    reach = np.broadcast_to(np.asarray(STEP * pixel, dtype=np.float32), mask.shape)
    for axis in (0, 1):
        one, two = _neighbours(axis)
        outline = (mask[one] != mask[two]) & outlines
        both = mask[one] & mask[two]
        turn = np.einsum("...d,...d->...", normal[one], normal[two]) < CREASE
        apart = point[two] - point[one]
        leaves_one = np.abs(np.einsum("...d,...d->...", normal[one], apart))
        leaves_two = np.abs(np.einsum("...d,...d->...", normal[two], apart))
        step = np.minimum(leaves_one, leaves_two) > reach[one]
        edge = outline | (both & (turn | step))
        lines[one] |= edge
        lines[two] |= outline
    return _widened(lines & mask, width) & mask


def face_edges(
    face: IntArray, depth: FloatArray, normals: FloatArray, axes: FloatArray, pixel: float, width: int
) -> BoolArray:
    """The same lines in a parallel view, without outlines, looked for only where two faces meet.

    Parameters
    ----------
    face:
        What each pixel sees, -1 where nothing, shape (h, w).
    depth:
        How far away, shape (h, w).
    normals:
        Unit normals of all faces, to either side, shape (m, 3).
    axes:
        Directions to the right, up and to the eye, as rows, shape (3, 3).
    pixel:
        Side of a pixel, in the unit of the depth.
    width:
        Width of the lines in pixels.
    """
    right, up, eye = axes
    lines = np.zeros(face.shape, dtype=bool)
    for axis, along in ((0, -up), (1, right)):
        one, two = _neighbours(axis)
        first, second = face[one], face[two]
        row, column = np.nonzero((first != second) & (first >= 0) & (second >= 0))
        apart = pixel * along - (depth[two][row, column] - depth[one][row, column])[:, None] * eye
        near, far = (_to_eye(normals[each[row, column]], eye) for each in (first, second))
        turn = np.einsum("kd,kd->k", near, far) < CREASE
        leaves = [np.abs(np.einsum("kd,kd->k", each, apart)) for each in (near, far)]
        edge = turn | (np.minimum(*leaves) > STEP * pixel)
        lines[one][row[edge], column[edge]] = True
    return _widened(lines, width) & (face >= 0)


def _to_eye(normals: FloatArray, eye: FloatArray) -> FloatArray:
    return normals * np.where(normals @ eye < 0, -1.0, 1.0)[:, None]


def _neighbours(axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    before, after = [slice(None)] * 2, [slice(None)] * 2
    before[axis], after[axis] = slice(None, -1), slice(1, None)
    return tuple(before), tuple(after)


def _widened(lines: BoolArray, width: int) -> BoolArray:
    for step in range(width - 1):
        wider = lines.copy()
        for axis in (0, 1):
            one, two = _neighbours(axis)
            if step % 2 == 0:  # grow to either side in turn, so that lines stay centred
                wider[two] |= lines[one]
            else:
                wider[one] |= lines[two]
        lines = wider
    return lines

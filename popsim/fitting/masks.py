"""Masks and what OpenCV does with them, on one thread: they are too small for more."""

from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.rendering.opencv import opencv

FloatImage = npt.NDArray[np.float32]


FAR = np.float32(np.inf)
"""Depth where nothing shows."""


@lru_cache(maxsize=2)
def _neighbours(around: bool) -> Any:
    cv2 = opencv()
    return cv2.getStructuringElement(cv2.MORPH_RECT if around else cv2.MORPH_CROSS, (3, 3))


def grown(mask: BoolArray, steps: int = 1, around: bool = False) -> BoolArray:
    """A mask and the cells some steps beside its cells; beside their corners too where all `around` is meant."""
    found: BoolArray = opencv().dilate(mask.view(np.uint8), _neighbours(around), iterations=steps).view(np.bool_)
    return found


def parts(mask: BoolArray) -> tuple[int, IntArray]:
    """Parts of a mask that hang together by the sides of cells: their number with 0, the rest, and each cell's."""
    count, labels = opencv().connectedComponents(mask.view(np.uint8), connectivity=4)
    return count, labels


def extent(mask: BoolArray) -> tuple[tuple[int, int], tuple[int, int]]:
    """First row and column in which a mask holds anything, and those after the last; both 0 where it is empty."""
    column, row, columns, rows = opencv().boundingRect(mask.view(np.uint8))
    return (row, column), (row + rows, column + columns)


def drawn(depth: FloatImage, shape: tuple[int, int], cells: FloatArray) -> FloatImage:
    """Draw an image into another of some shape, each pixel after the one nearest to its middle.

    Parameters
    ----------
    depth:
        Shape (n, m); FAR lies around it.
    shape:
        Rows and columns of the other.
    cells:
        Which column and row of the image a column and a row of the other show: affine functions of these and 1,
        shape (2, 3), in pixels from the middle of the first one.
    """
    cv2 = opencv()
    found: FloatImage = cv2.warpAffine(
        depth, cells, shape[::-1], flags=cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP, borderValue=np.inf
    )
    return found

"""Masks and what OpenCV does with them, on one thread: they are too small for more."""

from functools import lru_cache
from typing import Any

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray


@lru_cache(maxsize=1)
def _opencv() -> Any:
    import cv2

    cv2.setNumThreads(1)
    return cv2


def grown(mask: BoolArray, steps: int = 1, around: bool = False) -> BoolArray:
    """A mask and the cells some steps beside its cells; beside their corners too where all `around` is meant."""
    cv2 = _opencv()
    near = cv2.getStructuringElement(cv2.MORPH_RECT if around else cv2.MORPH_CROSS, (3, 3))
    return np.asarray(cv2.dilate(mask.view(np.uint8), near, iterations=steps).view(np.bool_))


def parts(mask: BoolArray) -> tuple[int, IntArray]:
    """Parts of a mask that hang together by the sides of cells: their number with 0, the rest, and each cell's."""
    count, labels = _opencv().connectedComponents(mask.view(np.uint8), connectivity=4)
    return count, labels


def drawn(mask: BoolArray, shape: tuple[int, int], cells: FloatArray) -> BoolArray:
    """Draw a mask into another of some shape.

    Parameters
    ----------
    mask:
        Shape (n, m).
    shape:
        Rows and columns of the other.
    cells:
        Which column and row of the mask a column and a row of the other show: affine functions of these and 1,
        shape (2, 3), in cells from the middle of the first one.
    """
    cv2 = _opencv()
    flags = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpAffine(mask.view(np.uint8), cells, shape[::-1], flags=flags).view(np.bool_))

"""Arrays at the boundary: float64, finite, of the expected shape, and read-only."""

from collections.abc import Sequence
from math import isfinite

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
UInt8Array = npt.NDArray[np.uint8]
BoolArray = npt.NDArray[np.bool_]


def locked(values: npt.ArrayLike, shape: Sequence[int | None], name: str) -> FloatArray:
    """Return `values` as a read-only float64 array.

    Parameters
    ----------
    values:
        Anything numpy can read.
    shape:
        The expected shape; None stands for any length.
    name:
        What the error calls the values.

    Raises
    ------
    GeometryError
        The shape differs, or a value is not finite.
    """
    array = values if _kept(values) else np.array(values, dtype=np.float64)
    assert isinstance(array, np.ndarray)  # for the type checker
    if array.shape != shape and not _fits(array.shape, shape):
        expected = " x ".join("n" if n is None else str(n) for n in shape)
        raise GeometryError(f"{name} must have shape {expected}, not {' x '.join(map(str, array.shape))}")
    # faster than to look at all values, and finite only where they are; large ones overflow
    if not isfinite(np.vdot(array, array)) and not np.isfinite(array).all():
        raise GeometryError(f"{name} must be finite numbers; found NaN or infinity")
    array.setflags(write=False)
    return array


def _kept(values: npt.ArrayLike) -> bool:
    """Whether nobody can write into an array any more, so that it need not be copied."""
    if not isinstance(values, np.ndarray) or values.base is not None or values.dtype != np.float64:
        return False
    return not values.flags.writeable and values.flags.c_contiguous


def _fits(have: Sequence[int], want: Sequence[int | None]) -> bool:
    """Whether a shape is one of those wanted."""
    unlike = [n for n, m in zip(have, want, strict=False) if m not in (None, n)]
    return len(have) == len(want) and not unlike


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross products of vectors (..., 3); numpy's own is slow on many small arrays."""
    x, y, z = first[..., 0], first[..., 1], first[..., 2]
    a, b, c = second[..., 0], second[..., 1], second[..., 2]
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)

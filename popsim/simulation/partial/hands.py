"""Which hinges are led by hand: one for each free motion."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray

FREE = 1e-5
"""mm of gap per mm of motion below which a motion counts as free, as for the stability of a whole design."""


def led_joints(matrix: FloatArray, fold: int | None) -> IntArray:
    """Joints that fix all free motions if they are held: `fold`, and as few others as need be; shape (f,).

    The rest are independent of each other, so that the loops decide over them. Something is led in any case:
    loops that only just do not close leave nothing free, and hands would try nevertheless. A loop that holds
    nothing together, as two halves of a patch on one line, leaves all free: what is left of it is rounding.

    Parameters
    ----------
    matrix:
        Gaps by joints, mm per mm, shape (r, c).
    fold:
        The joint of the card's own fold; None where the card is not there.
    """
    from scipy.linalg import qr

    count = matrix.shape[1]
    others = np.array([k for k in range(count) if k != fold], dtype=np.int64)
    if not len(matrix) or not len(others):
        return np.arange(count)
    corner, order = qr(matrix[:, others], mode="r", pivoting=True)
    size = np.abs(np.diag(corner))
    rank = int((size > FREE).sum())
    if fold is None:
        return np.sort(order[min(rank, count - 1) :])
    return np.sort(np.append(others[order[rank:]], fold))

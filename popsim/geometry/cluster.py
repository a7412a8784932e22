"""Points that hang together."""

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray


def linked(points: FloatArray, reach: float) -> IntArray:
    """Number the groups of points (n, 3) in which each lies within `reach` of another, 0 .. k - 1, shape (n,)."""
    from scipy.sparse import coo_array  # slow import
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    count = len(points)
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    numbers: IntArray = connected_components(links, directed=False)[1].astype(np.int64)
    return numbers

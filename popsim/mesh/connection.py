"""Whether the triangles of a surface hang together."""

import numpy as np

from popsim.geometry.surface import Surface
from popsim.geometry.weld import near_corner_numbers
from popsim.mesh.sampling import face_normals


def loose_share(surface: Surface) -> float:
    """Return the share of the area, 0..1, of triangles that share no edge with another one.

    Corners nearer to each other than a millionth of the extent are one.
    """
    numbers = np.sort(near_corner_numbers(surface.triangles), axis=1)
    most = int(numbers.max()) + 1
    edges = np.stack([numbers[:, a] * most + numbers[:, b] for a, b in ((0, 1), (1, 2), (0, 2))], axis=1)
    _, index, count = np.unique(edges, return_inverse=True, return_counts=True)
    alone = (count[index.reshape(edges.shape)] == 1).all(axis=1)
    areas = face_normals(surface)[1]
    return float(areas[alone].sum() / areas.sum())

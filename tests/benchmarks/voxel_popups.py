"""Pop-ups by voxels, as [LSH*10] and [LJGH11] make them, on the description of Sec. 1 and 5.

The model is voxelised and every column of voxels becomes a box of its own height. Faces of voxels that lie in one
plane and share an edge are one patch, and nothing is counted that stands inside: fewer patches than such a design
really needs, and its silhouette is that of the voxels exactly.
"""

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from popsim.fitting import measure_volume
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Material, Surface
from popsim.rendering.ray_scene import RayScene


@dataclass(frozen=True)
class VoxelPopup:
    """A pop-up of columns.

    Attributes
    ----------
    surface:
        The faces of its voxels, card frame, mm.
    patches:
        Planar pieces of them.
    columns:
        Boxes of one height each.
    """

    surface: Surface
    patches: int
    columns: int


def voxel_popup(scene: RayScene, bounds: FloatArray, cells: int) -> VoxelPopup:
    """Make the pop-up of a model with so many voxels along its longest side."""
    volume = measure_volume(scene, bounds, cells)
    solid = np.concatenate([volume.solid[1][:, ::-1], volume.solid[0]], axis=1)
    heights = np.where(solid.any(axis=2), solid.shape[2] - solid[:, :, ::-1].argmax(axis=2), 0)
    filled = np.arange(solid.shape[2]) < heights[..., None]
    origin = np.array([volume.x0, -volume.shape[1] * volume.cell, 0.0])
    quads, patches = [], 0
    for axis in range(3):
        for side in (0, 1):
            faces = filled & ~_neighbour(filled, axis, side)
            if (axis, side) == (2, 0):
                continue  # what stands on the page
            patches += sum(ndimage.label(layer)[1] for layer in np.moveaxis(faces, axis, 0))
            quads.append(_quads(np.argwhere(faces), axis, side) * volume.cell + origin)
    corners = np.concatenate(quads)
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    count = len(triangles)
    white = (Material(np.ones(4)),)
    surface = Surface(triangles, np.zeros((count, 3, 2)), np.zeros(count, dtype=np.int64), white)
    return VoxelPopup(surface, patches, int((heights > 0).sum()))


def _neighbour(filled: np.ndarray, axis: int, side: int) -> np.ndarray:
    """Whether the next voxel on a side is filled."""
    widths = [(0, 0)] * 3
    widths[axis] = (1, 1)
    padded = np.pad(filled, widths)
    return padded.take(range(2 * side, 2 * side + filled.shape[axis]), axis=axis)


def _quads(cells: np.ndarray, axis: int, side: int) -> FloatArray:
    """Corners (n, 4, 3) of one face of each of the cells (n, 3)."""
    first, second = (k for k in range(3) if k != axis)
    corners = np.zeros((4, 3))
    corners[:, axis] = side
    corners[[1, 2], first] = 1
    corners[[2, 3], second] = 1
    return cells[:, None] + corners

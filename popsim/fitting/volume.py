"""The model as solid and empty cells, from depth maps along the axes."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import BoolArray, FloatArray, locked

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

CELLS = 72
"""Cells along the longest side: on a card of 150 mm, 2 mm each; prisms then snap to the model's planes."""

RAYS = 2
"""Rays per cell and direction, squared; one that meets the model is enough, so that thin parts are not lost."""


@dataclass(frozen=True, eq=False)
class Volume:
    """Cells of a model that stands on z = 0 over both sides of the fold.

    Attributes
    ----------
    solid:
        Shape (2, nx, nu, nz): the ground half (y > 0) first, u = |y| counted from the fold.
    x0:
        Where the cells start along x, mm; u and z start at 0.
    cell:
        Edge of a cell, mm.
    """

    solid: BoolArray
    x0: float
    cell: float

    def __post_init__(self) -> None:
        self.solid.setflags(write=False)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells along x, u and z."""
        _, nx, nu, nz = self.solid.shape
        return nx, nu, nz

    def x(self, index: int) -> float:
        """Position of a cell border along x, mm."""
        return self.x0 + index * self.cell

    def reach(self, axis: int) -> tuple[float, float]:
        """Where the cells begin and end along x (axis 0), away from the fold (1) and upward (2), mm."""
        low = self.x0 if axis == 0 else 0.0
        return low, low + self.shape[axis] * self.cell

    def closed(self, radius: int) -> "Volume":
        """Return the volume with gaps of up to twice `radius` cells filled: what a lattice encloses is solid."""
        from scipy.ndimage import distance_transform_edt

        whole = np.concatenate([self.solid[1][:, ::-1], self.solid[0]], axis=1)
        padded = np.pad(whole, radius + 1)
        grown = distance_transform_edt(~padded) <= radius
        shrunk = distance_transform_edt(grown) > radius
        inner = slice(radius + 1, -radius - 1)
        filled = whole | shrunk[inner, inner, inner]
        nu = self.shape[1]
        return Volume(np.stack([filled[:, nu:], filled[:, :nu][:, ::-1]]), self.x0, self.cell)


def measure_volume(scene: "RayScene", bounds: FloatArray, cells: int = CELLS) -> Volume:
    """Read a surface as a volume.

    Parameters
    ----------
    scene:
        The model in the card frame, mm.
    bounds:
        What counts of it, rows low and high, shape (2, 3).
    cells:
        Along the longest side.

    Raises
    ------
    MeshError
        The model has no extent.
    """
    box = locked(bounds, (2, 3), "bounds")
    size = box[1] - box[0]
    if not size.max() > 0:
        raise MeshError("the model is a single point; nothing can be folded from it")
    half = float(np.abs(box[:, 1]).max())
    cell = float(max(size[0], 2 * half, size[2]) / cells)
    nx, nu, nz = (max(1, int(np.ceil(s / cell - 1e-9))) for s in (size[0], half, size[2]))
    low = np.array([box[0, 0], -nu * cell, 0.0])
    count = np.array([nx, 2 * nu, nz])
    solid = np.ones(tuple(count), dtype=bool)
    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1), (2, 1)):
        solid &= ~_seen(scene, low, count, cell, axis, sign)
    halves = np.stack([solid[:, nu:], solid[:, :nu][:, ::-1]])
    return Volume(halves, float(low[0]), cell)


def _seen(scene: "RayScene", low: FloatArray, count: FloatArray, cell: float, axis: int, sign: int) -> BoolArray:
    """Cells that are seen from outside, looking along -sign of an axis, shape `count`."""
    others = [k for k in range(3) if k != axis]
    steps = [(np.arange(count[k] * RAYS) + 0.5) * cell / RAYS + low[k] for k in others]
    first, second = np.meshgrid(*steps, indexing="ij")
    length = float(count[axis] * cell)
    origins = np.empty((first.size, 3))
    origins[:, others[0]], origins[:, others[1]] = first.ravel(), second.ravel()
    origins[:, axis] = low[axis] + (length + cell if sign > 0 else -cell)
    direction = np.zeros((1, 3))
    direction[0, axis] = -sign
    depth = scene.hit(origins, direction).distance.reshape(first.shape) - cell
    blocks = depth.reshape(count[others[0]], RAYS, count[others[1]], RAYS)
    nearest = blocks.min(axis=(1, 3))
    centres = (np.arange(count[axis]) + 0.5) * cell
    before = centres[::-sign] if sign > 0 else centres
    seen = before[None, None, :] < nearest[..., None] - 0.5 * cell
    return np.moveaxis(seen, -1, axis)

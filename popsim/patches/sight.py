"""What a plate sees of the model: parallel rays onto its plane, within a box of space (Sec. 4.3)."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray, UInt8Array
from popsim.geometry.plane import Plane
from popsim.geometry.raster import covered
from popsim.rendering.edges import face_edges
from popsim.rendering.light import Light
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.texture import Colours, eight_bit

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

PARALLEL = 1e-12
"""A direction with a component below this never leaves a slab of that axis."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Square pixels in the flat coordinates of a plane; row 0 is the upper one.

    Attributes
    ----------
    plane:
        Its normal points to the eye.
    low:
        Lower left corner, shape (2,).
    pixel:
        Side of a pixel, mm.
    shape:
        Rows and columns.
    """

    plane: Plane
    low: FloatArray
    pixel: float
    shape: tuple[int, int]

    @staticmethod
    def over(plane: Plane, bounds: tuple[float, float, float, float], pixel: float) -> "Grid":
        """The grid over flat bounds (left, lower, right, upper)."""
        low, high = np.array(bounds[:2]), np.array(bounds[2:])
        columns, rows = np.maximum(np.ceil((high - low) / pixel - 1e-6), 1).astype(int)
        return Grid(plane, low, pixel, (int(rows), int(columns)))

    def starts(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """x, y and z of the centres of all pixels, as arrays that broadcast to the grid's shape.

        A coordinate that does not change along rows or columns has length 1 there.
        """
        rows, columns = self.shape
        u = self.low[0] + (np.arange(columns) + 0.5) * self.pixel
        v = self.low[1] + (rows - np.arange(rows) - 0.5) * self.pixel
        found = []
        for origin, across, up in zip(self.plane.origin, self.plane.u, self.plane.v, strict=True):
            own = np.full((1, 1), origin)
            own = own + u[None, :] * across if across else own
            found.append(own + v[:, None] * up if up else own)
        return found[0], found[1], found[2]

    def points(self, which: IntArray) -> FloatArray:
        """The centres of some pixels, counted row by row, in space, shape (n, 3)."""
        row, column = np.divmod(which, self.shape[1])
        points = np.empty((len(which), 3))
        for axis, values in enumerate(self.starts()):
            rows, columns = values.shape
            points[:, axis] = values[row if rows > 1 else 0, column if columns > 1 else 0]
        return points

    def covered(self, shape: "BaseGeometry") -> BoolArray:
        """The pixels whose centres lie inside a flat shape, shape (rows, columns)."""
        return covered(shape, self.low, self.pixel, self.shape)

    def centres(self) -> FloatArray:
        """Flat coordinates of the centres of all pixels, row by row, shape (rows * columns, 2)."""
        rows, columns = self.shape
        u = self.low[0] + (np.arange(columns) + 0.5) * self.pixel
        v = self.low[1] + (rows - np.arange(rows) - 0.5) * self.pixel
        return np.stack(np.broadcast_arrays(u[None, :], v[:, None]), axis=-1).reshape(-1, 2)

    def flat(self, rows_columns: FloatArray) -> FloatArray:
        """Flat coordinates of (row, column) positions, where pixel centres are whole numbers; shape (n, 2)."""
        row, column = np.asarray(rows_columns, float).T
        u = self.low[0] + (column + 0.5) * self.pixel
        return np.column_stack([u, self.low[1] + (self.shape[0] - row - 0.5) * self.pixel])

    def pixels(self, line: FloatArray) -> IntArray:
        """Rows and columns of the pixels that a segment (2, 2) runs through, shape (n, 2); perhaps outside."""
        count = int(np.ceil(np.abs(line[1] - line[0]).max() / self.pixel * 2)) + 1
        points = line[0] + (line[1] - line[0]) * np.linspace(0, 1, count)[:, None]
        column, up = np.floor((points - self.low) / self.pixel).astype(np.int64).T
        return np.column_stack([self.shape[0] - 1 - up, column])


@dataclass(frozen=True, eq=False)
class Sight:
    """What each pixel of a grid sees.

    Attributes
    ----------
    grid:
        The pixels.
    depth:
        Behind the plane, mm; infinite where nothing is seen, shape (rows, columns).
    face, bary:
        Face of the scene, -1 where nothing is seen, and barycentric coordinates there, by pixel.
    """

    grid: Grid
    depth: FloatArray
    face: IntArray
    bary: FloatArray

    @property
    def mask(self) -> BoolArray:
        """Where something is seen, shape (rows, columns)."""
        return np.isfinite(self.depth)


def look(
    scene: RayScene, grid: Grid, box: FloatArray, near: float, far: FloatArray | float, *, bary: bool = True
) -> Sight:
    """Find what the pixels see of the part of the scene within a box.

    Parameters
    ----------
    scene:
        The model in the card frame, mm.
    grid:
        The pixels.
    box:
        Rows low and high, shape (2, 3).
    near, far:
        Least and greatest depth behind the plane; `far` may differ by pixel, shape (rows, columns) (NaN: not
        looked at).
    bary:
        Whether to tell where on its face each pixel ends; colours need it.
    """
    asked, start, stop = _asked(grid, box, near, far)
    hits = scene.hit(grid.points(asked), -grid.plane.normal[None], near=start, far=stop, bary=bary)
    count = grid.shape[0] * grid.shape[1]
    depth = np.full(count, np.inf)
    face = np.full(count, -1, dtype=np.int64)
    depth[asked], face[asked] = hits.distance, hits.face
    places = np.zeros((count if bary else 0, 3))
    if bary:
        places[asked] = hits.bary
    return Sight(grid, depth.reshape(grid.shape), face, places)


def shows(scene: RayScene, grid: Grid, box: FloatArray, near: float, far: FloatArray | float) -> BoolArray:
    """Tell which pixels see anything, shape (rows, columns); parameters as of :func:`look`, but faster."""
    asked, start, stop = _asked(grid, box, near, far)
    seen = np.zeros(grid.shape, dtype=bool)
    seen.ravel()[asked] = scene.meets(grid.points(asked), -grid.plane.normal[None], near=start, far=stop)
    return seen


def _asked(
    grid: Grid, box: FloatArray, near: float, far: FloatArray | float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """The pixels whose rays pass the box, counted row by row, and from where to where they are followed."""
    enter, leave = _within(box, grid)
    start, stop = (np.broadcast_to(ends, grid.shape) for ends in (np.maximum(enter, near), np.minimum(leave, far)))
    asked = np.flatnonzero(stop >= start)
    return asked, _of_asked(start, asked), _of_asked(stop, asked)


def _of_asked(values: FloatArray, asked: IntArray) -> FloatArray:
    """The values of some pixels, shape (n,); of all at once, shape (1,), where they are the same."""
    return values[0, :1] if values.strides == (0, 0) else values.ravel()[asked]


def colours(scene: RayScene, sight: Sight) -> UInt8Array:
    """Colours as they are, shape (rows, columns, 3); a model of one colour is softly lit.

    Pixels that see nothing are black.
    """
    seen = np.flatnonzero(sight.face >= 0)
    face, bary = sight.face[seen], sight.bary[seen]
    parts = map_chunks(lambda at: scene.paint.colours(face[at], bary[at], sight.grid.pixel), len(seen))
    found: Colours = np.concatenate(parts)
    if scene.paint.plain:
        plane = sight.grid.plane
        light = Light.of_view(plane.u, plane.v, plane.normal, plane.v)
        smooth = scene.shading_normals(face, bary, -plane.normal[None])
        squarely = light.shade(plane.normal.astype(np.float32))  # what lies in the plane keeps its colour
        found = scene.paint.paper(found)[:, :3] * (light.shade(smooth) / squarely)
    image = np.zeros((len(sight.face), 3), dtype=np.uint8)
    image[seen] = eight_bit(found[:, :3])
    return image.reshape(*sight.grid.shape, 3)


def lines(scene: RayScene, sight: Sight) -> BoolArray:
    """Steps and creases of what is seen, for models without colours, shape (rows, columns).

    Outlines are the edges of the paper.
    """
    grid, plane = sight.grid, sight.grid.plane
    axes = np.array([plane.u, plane.v, plane.normal])
    width = max(1, round(LINE_WIDTH / grid.pixel))
    return face_edges(sight.face.reshape(grid.shape), sight.depth, scene.normals, axes, grid.pixel, width)


LINE_WIDTH = 0.25
"""mm; width of the lines on models without colours."""


def _within(box: FloatArray, grid: Grid) -> tuple[FloatArray, FloatArray]:
    """Depths at which the rays of a grid enter and leave a box; they miss it where they leave before they enter.

    Arrays that broadcast to the shape of the grid: of a side that faces the eye squarely one number will do.
    """
    enter, leave = np.full((1, 1), -np.inf), np.full((1, 1), np.inf)
    for axis, start in enumerate(grid.starts()):
        direction = -grid.plane.normal[axis]
        to_low, to_high = box[0, axis] - start, box[1, axis] - start
        if abs(direction) < PARALLEL:
            leave = np.where((to_low > 0) | (to_high < 0), -np.inf, leave)
            continue
        first, last = (to_low, to_high) if direction > 0 else (to_high, to_low)
        enter, leave = np.maximum(enter, first / direction), np.minimum(leave, last / direction)
    return enter, leave

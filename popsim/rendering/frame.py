"""What a backend hands to the light: one unlit sample per pixel of the supersampled picture."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, IntArray
from popsim.rendering.camera import Camera
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene

Image = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Frame:
    """Unlit samples, shape (h, w) each.

    Attributes
    ----------
    colour:
        RGBA in 0..1, the colours multiplied by alpha, shape (h, w, 4); alpha is how much of it is covered.
    normal:
        Unit normals for shading, pointing to the viewer, shape (h, w, 3); zero where empty.
    point:
        What is seen, relative to the target of the camera, shape (h, w, 3); zero where empty.
    pixel:
        Side of a pixel there, in units of length, shape (h, w); zero where empty.
    """

    colour: Image
    normal: Image
    point: Image
    pixel: Image

    @property
    def mask(self) -> BoolArray:
        """Where a surface is seen, shape (h, w)."""
        result: BoolArray = self.colour[..., 3] > 0.5
        return result


def draw_with_rays(scene: RayScene, camera: Camera, rows: int, columns: int) -> Frame:
    """Return the samples that one ray per pixel finds."""

    def trace(part: slice) -> tuple[Image, ...]:
        origins, directions = camera.rays(rows, columns, part)
        hits = scene.hit(origins, directions, bary=True)
        seen = np.flatnonzero(hits.face >= 0)
        face, bary, along = hits.face[seen], hits.bary[seen], directions[seen]
        depth = hits.distance[seen] / np.linalg.norm(along, axis=1)
        pixel = camera.pixel_size(rows, depth)
        colour = scene.paint.paper(scene.paint.colours(face, bary, pixel))
        colour[:, 3] = 1.0
        samples = (
            colour,
            scene.shading_normals(face, bary, along),
            origins[seen] + along * depth[:, None] - camera.target,
            pixel[:, None],
        )
        return tuple(_scattered(values, seen, len(origins)) for values in samples)

    parts = map_chunks(trace, rows * columns)
    images = [np.concatenate(each).reshape(rows, columns, -1) for each in zip(*parts, strict=True)]
    return Frame(images[0], images[1], images[2], images[3][..., 0])


def _scattered(values: npt.NDArray[Any], at: IntArray, count: int) -> Image:
    result = np.zeros((count, values.shape[1]), dtype=np.float32)
    result[at] = values
    return result

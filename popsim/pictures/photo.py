"""Product shots: a surface on a table, in soft light, before a light backdrop."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.geometry.surface import Surface
from popsim.pictures.look import Look

if TYPE_CHECKING:
    from popsim.rendering.camera import Camera
    from popsim.rendering.ray_scene import RayScene

ABOVE, BELOW = (248, 249, 251), (222, 227, 233)
"""Colours of the backdrop at the upper and the lower border."""

UNDER = 0.1
"""mm between a surface and its table: what lies flat keeps the rim of its shadow."""

LENS = 22.0
"""Degrees of view: what lies in front is not much larger than what lies behind."""


def camera_for(box: FloatArray, look: Look) -> "Camera":
    """The camera of a look on all of a box (2, 3)."""
    from popsim.rendering.camera import Camera

    aspect = look.width / look.height
    return Camera.looking_at(box, look.azimuth, look.elevation, LENS, aspect=aspect, margin=0.05)


@dataclass(frozen=True, eq=False)
class Shot:
    """A picture that is set up, ready to be taken.

    Attributes
    ----------
    scene:
        The surface, prepared for rays.
    camera:
        On it.
    look:
        Size of the picture.
    """

    scene: "RayScene"
    camera: "Camera"
    look: Look

    @staticmethod
    def of(surface: Surface, camera: "Camera", look: Look) -> "Shot":
        """Set up a picture of a surface."""
        from popsim.rendering.ray_scene import RayScene

        return Shot(RayScene(surface), camera, look)

    def take(self) -> UInt8Array:
        """Take the picture, RGBA, shape (h, w, 4); the surface lies on a table."""
        from PIL import Image

        from popsim.rendering.picture import render_picture

        look, table = self.look, float(self.scene.surface.bounds[0, 2]) - UNDER
        size = look.width, look.height
        pixels = render_picture(self.scene, self.camera, size, background=None, floor=table).pixels
        scene = Image.fromarray(backdrop(look))
        scene.alpha_composite(Image.fromarray(pixels))
        return np.asarray(scene)


def photograph(surface: Surface, camera: "Camera", look: Look) -> UInt8Array:
    """Take a picture, RGBA, shape (h, w, 4); the surface lies on a table."""
    return Shot.of(surface, camera, look).take()


def backdrop(look: Look) -> UInt8Array:
    """The background, RGBA, shape (h, w, 4)."""
    share = np.linspace(0, 1, look.height)[:, None]
    column = np.rint((1 - share) * np.array([*ABOVE, 255]) + share * np.array([*BELOW, 255]))
    return np.repeat(column.astype(np.uint8)[:, None], look.width, axis=1)

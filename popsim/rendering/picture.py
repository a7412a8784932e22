"""Pictures of a surface for people: perspective, soft light, shadows, smooth borders."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from popsim.errors import InputError
from popsim.geometry.arrays import UInt8Array
from popsim.geometry.surface import Surface
from popsim.rendering.camera import Camera
from popsim.rendering.edges import feature_edges
from popsim.rendering.floor import with_floor
from popsim.rendering.frame import Frame, draw_with_rays
from popsim.rendering.light import LINE, Light
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.shadows import light_seen
from popsim.rendering.texture import eight_bit

Image = npt.NDArray[np.float32]
Backend = Literal["auto", "rays", "opengl"]
BACKENDS: tuple[Backend, ...] = ("auto", "rays", "opengl")
WHITE = (255, 255, 255, 255)


@dataclass(frozen=True, eq=False)
class Picture:
    """An image and how it was made.

    Attributes
    ----------
    pixels:
        RGBA, shape (h, w, 4), read-only.
    backend:
        "rays" or "opengl": what found out which surface each pixel sees.
    """

    pixels: UInt8Array
    backend: str

    def __post_init__(self) -> None:
        self.pixels.setflags(write=False)


def render_picture(
    scene: RayScene | Surface,
    camera: Camera,
    size: tuple[int, int] = (800, 600),
    *,
    background: Sequence[int] | None = WHITE,
    shadows: bool = True,
    floor: float | None = None,
    lines: bool = False,
    samples: int = 2,
    backend: Backend = "rays",
) -> Picture:
    """Return a lit picture of `scene`.

    Parameters
    ----------
    scene:
        A surface, or the scene prepared from it (cheaper for many pictures).
    camera:
        Where it is seen from, in the frame of the surface.
    size:
        Width and height in pixels.
    background:
        RGB or RGBA, 0..255; None for transparent.
    shadows:
        Soft shadows and darker corners, by rays whatever the backend.
    floor:
        Height z of a plane that shows nothing but the shadows on it; only with `shadows`.
    lines:
        Draw outlines, steps and creases.
    samples:
        Samples per pixel and direction, against stairs on slanted borders.
    backend:
        "rays" works everywhere and sets the standard; "opengl" needs a driver, and pays with a graphics
        card or with animations; "auto" takes OpenGL where it is found.

    Raises
    ------
    InputError
        The backend is unknown or not there, or a size is not positive.
    """
    if min(size) < 1 or samples < 1:
        raise InputError(f"a picture needs a positive size and samples, not {size} and {samples}")
    scene = scene if isinstance(scene, RayScene) else RayScene(scene)
    rows, columns = size[1] * samples, size[0] * samples
    chosen = _choose(backend)
    if chosen == "opengl":
        from popsim.rendering.opengl import draw_with_opengl

        frame = draw_with_opengl(scene, camera, rows, columns)
    else:
        frame = draw_with_rays(scene, camera, rows, columns)
    if shadows and floor is not None:
        frame = with_floor(frame, scene, camera, floor)
    colour = _lit(scene, camera, frame, shadows=shadows)
    if lines:
        edges = feature_edges(frame.mask, frame.normal, frame.point, frame.pixel, samples)
        colour[edges, :3] *= np.float32(LINE)
    small = _block_sums(np.minimum(colour, colour[..., 3:]), samples) / np.float32(samples**2)
    return Picture(_on_background(small, background), chosen)


def _choose(backend: Backend) -> str:
    if backend not in BACKENDS:
        raise InputError(f"backend {backend!r} is unknown; choose one of {', '.join(BACKENDS)}")
    if backend == "rays":
        return backend
    from popsim.rendering.opengl import opengl_missing

    missing = opengl_missing()
    if missing is None:
        return "opengl"
    if backend == "opengl":
        raise InputError(f"OpenGL cannot be used ({missing}); install a driver or choose the backend rays")
    return "rays"


def _lit(scene: RayScene, camera: Camera, frame: Frame, *, shadows: bool) -> Image:
    """Return the colours of a frame in its light, shape (h, w, 4), multiplied by alpha."""
    light = Light.of_view(camera.right, camera.up, camera.eye, camera.up)
    colour = frame.colour.copy()
    there = colour[..., 3] > 0
    if not shadows:
        colour[there, :3] *= light.shade(frame.normal[there])
        return colour
    key, dome = light_seen(scene, light, frame, camera.target)
    colour[there, :3] *= light.shade(frame.normal[there], key[there], dome[there])
    floor = ~there & (frame.pixel > 0)
    bright = light.shade(frame.normal[floor], key[floor], dome[floor]) / light.shade(frame.normal[floor])
    colour[floor, 3] = np.clip(1 - bright.mean(axis=1), 0, 1)
    return colour


def _block_sums(image: Image, samples: int) -> Image:
    rows, columns = image.shape[0] // samples, image.shape[1] // samples
    result: Image = image.reshape(rows, samples, columns, samples, -1).sum(axis=(1, 3))
    return result


def _on_background(image: Image, background: Sequence[int] | None) -> UInt8Array:
    """Return 8-bit pixels (h, w, 4) of an `image` whose colours are multiplied by alpha."""
    behind = np.zeros(4, dtype=np.float32)
    if background is not None:
        rgba = np.array([*background, 255][:4], dtype=np.float32) / 255
        behind = np.append(rgba[:3] * rgba[3], rgba[3]).astype(np.float32)
    result = image + (1 - image[..., 3:]) * behind
    result[..., :3] /= np.maximum(result[..., 3:], np.float32(1e-6))
    return eight_bit(result)

"""Samples of a picture by OpenGL (pyrender, without a window): what is slow by rays, fast on a graphics card.

OpenGL only finds out what is seen: one pass draws unlit colours, one draws normals as colours. Light, lines
and shadows are those of all backends. Limits: the context belongs to the thread that draws first; the card's
own four samples per pixel blur the border between two surfaces by a fraction of a sample; borders of holes
in a texture are as soft as its texels.
"""

import os
import sys
from ctypes.util import find_library
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.rendering.camera import Camera
from popsim.rendering.frame import Frame
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.texture import OPAQUE

PLATFORM = "PYOPENGL_PLATFORM"  # PyOpenGL reads it when it is first imported
HEADLESS = {"egl": "EGL", "osmesa": "OSMesa"}  # platforms that need no window, and their libraries

Image = npt.NDArray[np.float32]


@cache
def opengl_missing() -> str | None:
    """Return why OpenGL cannot be used, or None if it can."""
    try:
        _renderer()
    except Exception as error:  # a driver fails in as many ways as there are drivers
        return f"{type(error).__name__}: {error}".strip(": ")
    return None


@cache
def _renderer() -> Any:
    """Return the one renderer of the process: deleting one would take the others' contexts with it."""
    if PLATFORM not in os.environ and sys.platform.startswith("linux"):
        found = [name for name, library in HEADLESS.items() if find_library(library)]
        if not found:
            raise ImportError("neither libEGL nor libOSMesa is installed")
        os.environ[PLATFORM] = found[0]
    import pyrender
    from OpenGL import GL

    renderer = pyrender.OffscreenRenderer(8, 8)
    for state in (GL.GL_SAMPLE_ALPHA_TO_COVERAGE, GL.GL_SAMPLE_ALPHA_TO_ONE):  # holes let through
        GL.glEnable(state)
    return renderer


def draw_with_opengl(scene: RayScene, camera: Camera, rows: int, columns: int) -> Frame:
    """Return the samples that OpenGL finds; as :func:`popsim.rendering.frame.draw_with_rays`."""
    near, far = _clip_planes(scene, camera)
    colours = _corner_colours(scene)
    codes = np.concatenate([(scene.corner_normals + 1) / 2, colours[..., 3:]], axis=-1)
    stage = _Stage(scene, camera, rows, columns, near, far)
    colour, depth = stage.draw(colours, normals=False)
    normal, _ = stage.draw(codes, normals=True)
    if not camera.perspective:
        depth = _orthographic_depth(depth, near, far)

    def finish(part: slice) -> tuple[Image, Image]:
        origins, directions = camera.rays(rows, columns, part)
        away = depth.reshape(-1, 1)[part]
        points = np.where(away > 0, origins - camera.target + directions * away, 0.0)
        sample = normal.reshape(-1, 4)[part]
        towards = sample[:, :3] * 2 - sample[:, 3:]  # of colours multiplied by alpha
        towards /= np.maximum(np.linalg.norm(towards, axis=1, keepdims=True), np.float32(1e-6))
        behind = np.einsum("kd,kd->k", towards, directions) > 0
        towards[behind] *= -1
        return towards, points.astype(np.float32)

    parts = map_chunks(finish, rows * columns)
    facing, points = (np.concatenate(each).reshape(rows, columns, 3) for each in zip(*parts, strict=True))
    pixel = np.where(depth > 0, camera.pixel_size(rows, depth), 0.0).astype(np.float32)
    return Frame(colour, facing, points, pixel)


@dataclass(frozen=True, eq=False)
class _Stage:
    """A scene and the frustum that is drawn of it."""

    scene: RayScene
    camera: Camera
    rows: int
    columns: int
    near: float
    far: float

    def draw(self, corners: Image, *, normals: bool) -> tuple[Image, FloatArray]:
        """Return colours (h, w, 4), multiplied by alpha, and the depth (h, w) that pyrender reports."""
        import pyrender

        stage = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0])
        target = self.camera.target
        stage.add(pyrender.Mesh(primitives=_primitives(self.scene, target, corners, normals=normals)))
        pose = np.eye(4)
        pose[:3, :3] = np.column_stack([self.camera.right, self.camera.up, self.camera.eye])
        pose[:3, 3] = self.camera.position - target
        stage.add(self._lens(), pose=pose)
        renderer = _renderer()
        renderer.viewport_width, renderer.viewport_height = self.columns, self.rows
        flags = pyrender.RenderFlags
        image, depth = renderer.render(stage, flags.FLAT | flags.RGBA | flags.SKIP_CULL_FACES)
        return image.astype(np.float32) / 255, depth.astype(np.float64)

    def _lens(self) -> Any:
        import pyrender

        half, aspect = self.camera.height / 2, self.columns / self.rows
        planes = {"znear": self.near, "zfar": self.far}
        if not self.camera.perspective:
            return pyrender.OrthographicCamera(half * aspect, half, **planes)
        angle = 2 * np.arctan(half / self.camera.distance)
        return pyrender.PerspectiveCamera(angle, aspectRatio=aspect, **planes)


def _primitives(scene: RayScene, origin: FloatArray, corners: Image, *, normals: bool) -> list[Any]:
    """Return one pyrender primitive per material that is used."""
    import pyrender

    surface = scene.surface
    result = []
    for index in np.unique(surface.material):
        faces = np.flatnonzero(surface.material == index)
        image = _texture(surface.materials[index].texture, normals=normals)
        texture = None if image is None else pyrender.Texture(source=image, source_channels="RGBA")
        material = pyrender.MetallicRoughnessMaterial(baseColorTexture=texture, doubleSided=True)
        result.append(
            pyrender.Primitive(
                positions=(surface.triangles[faces] - origin).reshape(-1, 3),
                texcoord_0=None if image is None else surface.uv[faces].reshape(-1, 2),
                color_0=corners[faces].reshape(-1, 4),
                material=material,
            )
        )
    return result


def _texture(image: UInt8Array | None, *, normals: bool) -> UInt8Array | None:
    """Return the image with alpha 0 or 255; white for the pass of normals, None where it has no holes."""
    if image is None:
        return None
    solid = image[..., 3:] >= OPAQUE * 255
    if normals and solid.all():
        return None
    colours = np.full_like(image[..., :3], 255) if normals else image[..., :3]
    return np.concatenate([colours, np.where(solid, np.uint8(255), np.uint8(0))], axis=-1)


def _corner_colours(scene: RayScene) -> Image:
    """Return material times corner colours, shape (m, 3, 4), with alpha 0 or 1."""
    surface = scene.surface
    colours = np.array([m.colour for m in surface.materials])[surface.material][:, None]
    colours = np.repeat(colours, 3, axis=1) if surface.colours is None else colours * surface.colours
    result = scene.paint.paper(colours.reshape(-1, 4).astype(np.float32)).reshape(-1, 3, 4).copy()
    result[..., 3] = result[..., 3] >= OPAQUE
    return result


def _clip_planes(scene: RayScene, camera: Camera) -> tuple[float, float]:
    depths = (camera.position - scene.surface.triangles.reshape(-1, 3)) @ camera.eye
    slack = scene.size * 0.01
    low, high = float(depths.min()) - slack, float(depths.max()) + slack
    near = max(low, 1e-3 * camera.distance)  # what is behind the camera is not seen
    return near, max(high, 2 * near)


def _orthographic_depth(reported: FloatArray, near: float, far: float) -> FloatArray:
    """Return the true depth: pyrender linearises every depth as if the camera were perspective."""
    safe = np.where(reported > 0, reported, 1.0)
    z = ((far + near) - 2 * near * far / safe) / (far - near)
    return np.where(reported > 0, ((far - near) * z + far + near) / 2, 0.0)

"""A floor that is not there: it catches shadows and lets the background through."""

from dataclasses import replace

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.rendering.camera import Camera
from popsim.rendering.frame import Frame
from popsim.rendering.ray_scene import RayScene

BESIDE = 2.5  # times the height of the scene over the floor: farther beside it shadows are too faint to be seen
RIM = 0.05  # times its size: what is flat has a shadow as well
UP = np.array([0.0, 0.0, 1.0], dtype=np.float32)


def with_floor(frame: Frame, scene: RayScene, camera: Camera, height: float) -> Frame:
    """Return a frame whose empty samples have points and normals on the plane z = `height`, near the scene.

    They stay without colour; whoever lights them turns missing light into black of some alpha.
    """
    rows, columns = frame.pixel.shape
    empty = np.flatnonzero(frame.pixel == 0)
    origins, directions = camera.rays(rows, columns, empty)
    falling = directions[:, 2] < 0
    along = np.divide(height - origins[:, 2], directions[:, 2], out=np.full(len(empty), -1.0), where=falling)
    points = origins + along[:, None] * directions
    kept = np.flatnonzero((along > 0) & _near(points, scene, height))
    point, normal, pixel = (np.array(image) for image in (frame.point, frame.normal, frame.pixel))
    at = empty[kept]
    point.reshape(-1, 3)[at] = points[kept] - camera.target
    normal.reshape(-1, 3)[at] = UP
    pixel.ravel()[at] = camera.pixel_size(rows, along[kept])
    return replace(frame, point=point, normal=normal, pixel=pixel)


def _near(points: FloatArray, scene: RayScene, height: float) -> BoolArray:
    """Which points (n, 3) of the floor shadows may fall on."""
    low, high = scene.surface.bounds
    reach = BESIDE * max(high[2] - height, 0.0) + RIM * scene.size
    beside = [np.maximum(low[k] - points[:, k], points[:, k] - high[k]).clip(0.0) for k in (0, 1)]
    return np.asarray(np.hypot(*beside) < reach)

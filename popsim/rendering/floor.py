"""A floor that is not there: it catches shadows and lets the background through."""

from dataclasses import replace

import numpy as np

from popsim.geometry.arrays import BoolArray
from popsim.rendering.camera import Camera
from popsim.rendering.frame import Frame
from popsim.rendering.ray_scene import RayScene

AROUND = 2.5  # times the size of the scene: shadows are not looked for farther from its middle
UP = np.array([0.0, 0.0, 1.0], dtype=np.float32)


def with_floor(frame: Frame, scene: RayScene, camera: Camera, height: float) -> Frame:
    """Return a frame whose empty samples have points and normals on the plane z = `height`, near the scene.

    They stay without colour; whoever lights them turns missing light into black of some alpha.
    """
    rows, columns = frame.pixel.shape
    empty = np.flatnonzero(frame.pixel == 0)
    origins, directions = camera.rays(rows, columns, slice(0, rows * columns))
    origins, directions = origins[empty], directions[empty]
    falling = directions[:, 2] < 0
    along = np.divide(height - origins[:, 2], directions[:, 2], out=np.full(len(empty), -1.0), where=falling)
    points = origins + along[:, None] * directions
    middle = scene.surface.bounds.mean(axis=0)
    near: BoolArray = np.hypot(*(points - middle)[:, :2].T) < AROUND * scene.size
    kept = np.flatnonzero((along > 0) & near)
    point, normal, pixel = (np.array(image) for image in (frame.point, frame.normal, frame.pixel))
    at = empty[kept]
    point.reshape(-1, 3)[at] = points[kept] - camera.target
    normal.reshape(-1, 3)[at] = UP
    pixel.ravel()[at] = camera.pixel_size(rows, along[kept])
    return replace(frame, point=point, normal=normal, pixel=pixel)

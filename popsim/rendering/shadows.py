"""Soft shadows: how much of the key light and of the dome each point sees."""

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.rendering.light import Light
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene

Values = npt.NDArray[np.float32]

DOME_RAYS = 96  # over the whole sphere; those below the surface are not traced
KEY_RAYS = 18
KEY_RADIUS = 0.10  # of the key light, seen from the surface (radians); the softness of its shadows
REACH = 1.2  # times the size of the scene: how far the dome is searched, so that insides stay readable
LIFT = 0.75  # pixels off the surface; OpenGL knows depth at a corner of the pixel, not at its centre
GOLDEN = np.pi * (3.0 - np.sqrt(5.0))


def light_seen(
    scene: RayScene,
    light: Light,
    *,
    points: FloatArray,
    normals: Values,
    pixel: Values,
    phase: IntArray,
    phases: int,
) -> tuple[Values, Values, Values]:
    """Return key, dome and weight, shape (n,) each.

    Over the samples of a pixel, the mean of `key` and the sum of `dome` by the sum of `weight` are the parts
    of the key light and of the dome that are seen. The rays are shared out over the samples of a pixel:
    each traces only those of its own phase, so that the samples together have traced all, and pictures stay
    free of noise.

    Parameters
    ----------
    points:
        Shape (n, 3).
    normals:
        Unit normals that point to the viewer, shape (n, 3).
    pixel:
        Side of a pixel at the points, shape (n,).
    phase:
        Which share of the rays each point traces, 0 .. phases - 1, shape (n,).
    phases:
        Number of shares.
    """
    dome, key = sphere_directions(DOME_RAYS), cone_directions(light.key, KEY_RADIUS, KEY_RAYS)
    lifted = points + normals * (4 * scene.tolerance + LIFT * pixel)[:, None]

    def trace(part: slice) -> Values:
        sums = np.zeros((3, part.stop - part.start), dtype=np.float32)
        for share in range(phases):
            at = np.flatnonzero(phase[part] == share)
            start, normal = lifted[part][at], normals[part][at]
            mine = key[share::phases]
            for direction in mine:
                sums[0, at] += _seen(scene, start, normal, direction, np.inf)[0] / len(mine)
            for direction in dome[share::phases]:
                seen, weight = _seen(scene, start, normal, direction, REACH * scene.size)
                sums[1, at] += seen * weight
                sums[2, at] += weight
        return sums

    key_seen, dome_seen, weight = np.concatenate(map_chunks(trace, len(points)), axis=1)
    return key_seen, dome_seen, weight


def _seen(
    scene: RayScene, start: FloatArray, normal: Values, direction: FloatArray, far: float
) -> tuple[Values, Values]:
    """Return whether each point sees `direction` (0 or 1), and the cosine under which it would."""
    cosine = np.clip(normal @ direction.astype(np.float32), 0, None)
    seen = np.zeros(len(start), dtype=np.float32)
    above = np.flatnonzero(cosine > 0)
    if len(above):
        seen[above] = ~scene.occluded(start[above], direction[None], far=far)
    return seen, cosine


def sphere_directions(count: int) -> FloatArray:
    """Return `count` unit directions spread evenly over the sphere (a Fibonacci spiral), shape (count, 3)."""
    z = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = GOLDEN * np.arange(count)
    ring = np.sqrt(1.0 - z * z)
    return np.column_stack([ring * np.cos(angle), ring * np.sin(angle), z])


def cone_directions(axis: FloatArray, radius: float, count: int) -> FloatArray:
    """Return unit directions spread evenly over a cone about the unit `axis`, shape (count, 3)."""
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    reach = radius * np.sqrt((np.arange(count) + 0.5) / count)
    angle = GOLDEN * np.arange(count)
    offset = np.outer(reach * np.cos(angle), side) + np.outer(reach * np.sin(angle), np.cross(axis, side))
    result: FloatArray = axis + offset
    result /= np.linalg.norm(result, axis=1, keepdims=True)
    return result

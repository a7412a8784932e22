"""Soft shadows: how much of the key light and of the dome each sample of a picture sees.

Many rays are shared out over the samples of a small window: each traces its own few, and what the samples of the
window have found is put together where they lie on one surface. Every sample is then lit as if it had traced
all, and pictures are free of noise and of bands.
"""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray
from popsim.geometry.directions import cone_directions, sphere_directions
from popsim.rendering.frame import Frame
from popsim.rendering.light import Light
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import RayScene

Values = npt.NDArray[np.float32]

WINDOW = 4  # samples per side that share their rays
SHARES = WINDOW**2
DOME_RAYS = 12 * SHARES  # over the whole sphere; those below the surface are not traced
KEY_RAYS = 4 * SHARES
KEY_RADIUS = 0.10  # of the key light, seen from the surface (radians); the softness of its shadows
REACH = 1.2  # times the size of the scene: how far the dome is searched, so that insides stay readable
LIFT = 0.75  # samples off the surface; OpenGL knows depth at a corner of the sample, not at its centre
ALIKE = 0.95  # cosine between normals of one surface
FLUSH = 1.5  # samples by which points of one surface may leave each other's tangent planes


def light_seen(scene: RayScene, light: Light, frame: Frame, target: FloatArray) -> tuple[Values, Values]:
    """Return which parts of the key light and of the dome the samples see, 0..1, shape (h, w) each.

    Parameters
    ----------
    frame:
        What is seen; samples whose side is 0 are empty, and stay dark.
    target:
        What the points of the frame are relative to, shape (3,).
    """
    rows, columns = frame.pixel.shape
    at = np.flatnonzero(frame.pixel)
    row, column = np.divmod(at, columns)
    share = (row % WINDOW) * WINDOW + column % WINDOW
    normals = frame.normal.reshape(-1, 3)[at]
    lift = (4 * scene.tolerance + LIFT * frame.pixel.ravel()[at])[:, None]
    starts = frame.point.reshape(-1, 3)[at] + target + normals * lift
    order = np.argsort(share, kind="stable")  # samples of a share trace the same directions together
    found = np.zeros((3, rows * columns), dtype=np.float32)
    traced = map_chunks(
        lambda part: _traced(scene, light, starts[order[part]], normals[order[part]], share[order[part]]), len(at)
    )
    found[:, at[order]] = np.concatenate(traced, axis=1)
    key, dome, weight, count = _gathered(found.reshape(3, rows, columns), frame)
    return key / np.maximum(count, 1), dome / np.maximum(weight, np.float32(1e-6))


def _traced(
    scene: RayScene, light: Light, starts: FloatArray, normals: Values, share: npt.NDArray[np.int64]
) -> Values:
    """Return key, dome and weight of samples that trace their shares of the rays, shape (3, n)."""
    dome, key = sphere_directions(DOME_RAYS), cone_directions(light.key, KEY_RADIUS, KEY_RAYS)
    sums = np.zeros((3, len(starts)), dtype=np.float32)
    for each in np.unique(share):
        at = np.flatnonzero(share == each)
        start, normal = starts[at], normals[at]
        mine = key[each::SHARES]
        for direction in mine:
            sums[0, at] += _seen(scene, start, normal, direction, np.inf)[0] / len(mine)
        for direction in dome[each::SHARES]:
            seen, weight = _seen(scene, start, normal, direction, REACH * scene.size)
            sums[1, at] += seen * weight
            sums[2, at] += weight
    return sums


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


def _gathered(found: Values, frame: Frame) -> Values:
    """Return sums of `found` (3, h, w), and their number, over the window of each sample, shape (4, h, w)."""
    there = (frame.pixel > 0)[None].astype(np.float32)
    values = np.concatenate([found, there])
    sums = np.zeros_like(values)
    normal, point = (np.ascontiguousarray(np.moveaxis(image, -1, 0)) for image in (frame.normal, frame.point))
    level = (normal * point).sum(axis=0)
    for here, other in _windows(frame.pixel.shape):
        turn, leaves = np.zeros((2, *frame.pixel[here].shape), dtype=np.float32)
        for axis in range(3):
            turn += normal[axis][here] * normal[axis][other]
            leaves += normal[axis][here] * point[axis][other]
        one = (turn > ALIKE) & (np.abs(leaves - level[here]) < FLUSH * frame.pixel[here])
        sums[(slice(None), *here)] += values[(slice(None), *other)] * one
    return sums


def _windows(shape: tuple[int, int]) -> Iterator[tuple[tuple[slice, slice], tuple[slice, slice]]]:
    """Yield the samples that have a neighbour at each place of the window, and these neighbours."""
    steps = range(-(WINDOW // 2) + 1, WINDOW // 2 + 1)
    for down in steps:
        for right in steps:
            pairs = [_shifted(step, length) for step, length in zip((down, right), shape, strict=True)]
            yield (pairs[0][0], pairs[1][0]), (pairs[0][1], pairs[1][1])


def _shifted(step: int, length: int) -> tuple[slice, slice]:
    return slice(max(0, -step), length - max(0, step)), slice(max(0, step), length + min(0, step))

"""Surfaces made of blocks, for fitting."""

import numpy as np

from popsim.fitting import Subject, measure_volume
from popsim.fitting.snap import Planes
from popsim.geometry.surface import Material, Surface
from popsim.rendering.ray_scene import RayScene

_QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> np.ndarray:
    """The 12 triangles of a box."""
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    quads = corners[np.array(_QUADS)]
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def roof(low: tuple[float, float, float], high: tuple[float, float, float]) -> np.ndarray:
    """A triangular prism along x."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    ridge = 0.5 * (y0 + y1)
    a, b = ([np.array([x, y0, z0]), np.array([x, y1, z0]), np.array([x, ridge, z1])] for x in (x0, x1))
    faces = [a, b[::-1]]
    for k in range(3):
        m = (k + 1) % 3
        faces += [[a[k], b[k], b[m]], [a[k], b[m], a[m]]]
    return np.array(faces)


def quarter_turned(triangles: np.ndarray) -> np.ndarray:
    """The same about the vertical by a quarter turn."""
    return triangles @ np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def surface(*parts: np.ndarray) -> Surface:
    """Triangles as a plain surface."""
    triangles = np.concatenate(parts)
    count = len(triangles)
    return Surface(triangles, np.zeros((count, 3, 2)), np.zeros(count, int), (Material(np.ones(4)),))


def subdivided(triangles: np.ndarray, times: int) -> np.ndarray:
    """The same surface in 4 ** times as many triangles."""
    for _ in range(times):
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = np.concatenate([np.stack(q, axis=1) for q in quarters])
    return triangles


def subject_of(shape: Surface) -> Subject:
    """What fitting needs of a surface."""
    from popsim.mesh.sampling import sample_surface, spread

    samples = sample_surface(shape, 8000, seed=0)
    planes = Planes.of(samples.points, samples.normals, samples.area, 0.5)
    scene = RayScene(shape)
    points = spread(samples, shape.bounds, 1000, 0)
    return Subject(scene, shape.bounds, measure_volume(scene, shape.bounds), planes, points)


def painted(views, pictures):
    """Pictures put into views, shape (views, n, n); inf where nothing shows."""
    image = np.full((len(views.axes), views.pixels, views.pixels), np.inf)
    for spans, depth in pictures:
        parts = np.split(depth, np.cumsum((spans[:, 2] - spans[:, 1]) * (spans[:, 4] - spans[:, 3])))
        for (view, top, end, left, right), part in zip(spans, parts, strict=False):
            own = image[view, top:end, left:right]
            np.minimum(own, part.reshape(own.shape), out=own)
    return image

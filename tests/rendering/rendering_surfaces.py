"""Surfaces made by hand, for the tests of the renderer."""

import numpy as np

from popsim.geometry.surface import Material, Surface

WHITE = np.ones(4)


def surface(triangles, *, uv=None, colour=WHITE, texture=None, colours=None):
    """A surface of one material."""
    triangles = np.asarray(triangles, dtype=np.float64)
    uv = np.zeros((len(triangles), 3, 2)) if uv is None else uv
    material = np.zeros(len(triangles), dtype=int)
    return Surface(triangles, uv, material, (Material(np.asarray(colour), texture),), colours)


def joined(*surfaces):
    """Several surfaces in one."""
    firsts = np.cumsum([0] + [len(s.materials) for s in surfaces])
    corner_colours = [np.ones((len(s.triangles), 3, 4)) if s.colours is None else s.colours for s in surfaces]
    return Surface(
        np.concatenate([s.triangles for s in surfaces]),
        np.concatenate([s.uv for s in surfaces]),
        np.concatenate([s.material + first for s, first in zip(surfaces, firsts, strict=False)]),
        tuple(m for s in surfaces for m in s.materials),
        np.concatenate(corner_colours),
    )


def quad(corners, **looks):
    """Two triangles; corners counter-clockwise from the lower left, texture coordinates 0..1."""
    corners = np.asarray(corners, dtype=np.float64)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float64) * looks.pop("repeat", 1)
    halves = [[0, 1, 2], [0, 2, 3]]
    return surface(corners[halves], uv=uv[halves], **looks)


def upright(z=0.0, low=(0.0, 0.0), high=(10.0, 10.0), **looks):
    """A rectangle in the plane of height z that faces +z."""
    (x0, y0), (x1, y1) = low, high
    return quad([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]], **looks)


def box(low, high, **looks):
    """Twelve triangles that face outwards."""
    x, y, z = np.array([low, high], dtype=np.float64).T
    sides = [
        [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)],
        [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
        [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
        [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
        [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
        [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
    ]
    corners = np.array([[[x[i], y[j], z[k]] for i, j, k in side] for side in sides])
    return surface(corners[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3), **looks)


def sphere(radius=1.0, steps=24, **looks):
    """A sphere of latitude bands; corners lie on the sphere."""
    polar, round_ = np.meshgrid(
        np.linspace(0, np.pi, steps + 1), np.linspace(0, 2 * np.pi, 2 * steps + 1), indexing="ij"
    )
    points = radius * np.stack(
        [np.sin(polar) * np.cos(round_), np.sin(polar) * np.sin(round_), np.cos(polar)], axis=-1
    )
    points[:, -1] = points[:, 0]  # the seam closes exactly, and so do the poles
    points[[0, -1]] = [[[0, 0, radius]], [[0, 0, -radius]]]
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    triangles = np.concatenate(
        [np.stack([a, b, c], 2).reshape(-1, 3, 3), np.stack([a, c, d], 2).reshape(-1, 3, 3)]
    )
    edges = triangles[:, 1:] - triangles[:, :1]
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    return surface(triangles[area > 1e-9 * radius**2], **looks)

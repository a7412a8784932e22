"""Models made by hand, for the tests of the patches: boxes with a colour per side."""

import numpy as np

from popsim.geometry.surface import Material, Surface

RED, GREEN, BLUE, YELLOW, CYAN, WHITE = (
    np.array([*rgb, 1.0]) for rgb in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 1, 1)]
)
SIDES = {
    (0, 1): RED,
    (0, -1): GREEN,
    (1, 1): BLUE,
    (1, -1): YELLOW,
    (2, 1): CYAN,
    (2, -1): WHITE,
}
"""Colour of each side of a box, by axis and direction."""


def coloured_box(low, high):
    """Twelve triangles that face outward, with the colours of SIDES."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    triangles = []
    for axis, sign in SIDES:
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = np.zeros((4, 3))
        corners[:, axis] = (high if sign > 0 else low)[axis]
        corners[:, u] = np.array([low[u], high[u], high[u], low[u]])
        corners[:, v] = np.array([low[v], low[v], high[v], high[v]])
        corners = corners if sign > 0 else corners[::-1]
        triangles += [corners[[0, 1, 2]], corners[[0, 2, 3]]]
    material = np.repeat(np.arange(6), 2)
    materials = tuple(Material(colour) for colour in SIDES.values())
    return Surface(np.array(triangles), np.zeros((12, 3, 2)), material, materials)


def joined(*surfaces):
    """Several boxes in one surface."""
    return Surface(
        np.concatenate([s.triangles for s in surfaces]),
        np.concatenate([s.uv for s in surfaces]),
        np.concatenate([s.material for s in surfaces]),
        surfaces[0].materials,
    )


def box_of(surface, margin=30.0):
    """A territory that holds all of a surface."""
    low, high = surface.bounds
    return np.array([low - margin, high + margin])


def slab(profile, low, high):
    """A shapely polygon in the plane of x and z, holes included, made solid from y = low to y = high."""
    from mapbox_earcut import triangulate_float64

    rings = [np.array(ring.coords)[:-1] for ring in (profile.exterior, *profile.interiors)]
    points = np.concatenate(rings)
    ends = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
    faces = np.asarray(triangulate_float64(points, ends), dtype=np.int64).reshape(-1, 3)
    sides = [np.insert(points, 1, y, axis=1) for y in (low, high)]
    triangles = [side[faces] for side in sides]
    for ring in rings:
        near, far = (np.insert(ring, 1, y, axis=1) for y in (low, high))
        next_near, next_far = np.roll(near, -1, axis=0), np.roll(far, -1, axis=0)
        triangles += [np.stack([near, next_near, next_far], axis=1), np.stack([near, next_far, far], axis=1)]
    triangles = np.concatenate(triangles)
    count = len(triangles)
    return Surface(triangles, np.zeros((count, 3, 2)), np.zeros(count, int), (Material(BLUE),))

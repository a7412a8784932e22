"""Shading normals: round where a model is meant round, sharp where it has edges."""

import numpy as np
from rendering_surfaces import box, sphere

from popsim.rendering.ray_scene import RayScene
from popsim.rendering.smooth_normals import smooth_normals


def test_a_box_stays_sharp():
    scene = RayScene(box([0, 0, 0], [1, 2, 3]))
    expected = np.repeat(scene.normals[:, None], 3, axis=1)
    np.testing.assert_allclose(scene.corner_normals, expected, atol=1e-6)


def test_a_sphere_becomes_round():
    scene = RayScene(sphere(2.0, steps=24))
    off = scene.corner_normals - scene.surface.triangles / 2.0
    flat = scene.normals[:, None] - scene.surface.triangles / 2.0
    assert np.abs(off).max() < 0.4 * np.abs(flat).max()


def test_neighbours_turned_inside_out_are_joined_and_keep_their_side():
    scene = RayScene(sphere(2.0, steps=24))
    triangles = scene.surface.triangles.copy()
    triangles[::3] = triangles[::3, ::-1]
    turned = RayScene(
        type(scene.surface)(triangles, scene.surface.uv, scene.surface.material, scene.surface.materials)
    )
    result = smooth_normals(triangles, turned.normals)
    result[::3] = -result[::3, ::-1]
    np.testing.assert_allclose(result, scene.corner_normals, atol=1e-5)

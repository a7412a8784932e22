"""Shading normals: round where a model is meant round, sharp where it has edges."""

import numpy as np
from rendering_surfaces import box, sphere

from popsim.geometry.weld import corner_numbers
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.smooth_normals import SMOOTH, smooth_normals


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
    turned = type(scene.surface)(triangles, scene.surface.uv, scene.surface.material, scene.surface.materials)
    result = smooth_normals(turned, corner_numbers(triangles).astype(np.int32))
    result[::3] = -result[::3, ::-1]
    np.testing.assert_allclose(result, scene.corner_normals, atol=1e-5)


def test_a_corner_is_the_mean_of_the_faces_that_nearly_continue_its_own():
    """By the plain rule, on a surface with narrow and wide corners, inside out here and there."""
    rng = np.random.default_rng(6)
    ball = sphere(2.0, steps=12)
    bent = ball.triangles.copy()
    numbers = corner_numbers(bent).astype(np.int32)
    bent += rng.normal(scale=0.15, size=(numbers.max() + 1, 3))[numbers]
    bent[::5] = bent[::5, ::-1]
    numbers[::5] = numbers[::5, ::-1]
    surface = type(ball)(bent, ball.uv, ball.material, ball.materials)
    normals, areas = surface.normals, surface.areas
    expected = np.zeros((len(bent), 3, 3))
    for face, corners in enumerate(numbers):
        for k, corner in enumerate(corners):
            around = np.flatnonzero((numbers == corner).any(axis=1))
            turn = normals[around] @ normals[face]
            near = np.abs(turn) > SMOOTH
            total = (np.sign(turn[near]) * areas[around][near]) @ normals[around][near]
            expected[face, k] = total / np.linalg.norm(total)
    np.testing.assert_allclose(smooth_normals(surface, numbers), expected, atol=1e-5)

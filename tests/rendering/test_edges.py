"""Lines between faces are those that a look at all pixels finds."""

import numpy as np
import pytest
from rendering_surfaces import box, joined, sphere

from popsim.rendering.edges import face_edges, feature_edges
from popsim.rendering.maps import render_maps
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.view import View


@pytest.mark.parametrize("eye", [(1, 0, 0), (0, 0, 1), (0.6, 0.2, 0.8)])
@pytest.mark.parametrize("width", [1, 2])
def test_lines_between_faces_are_those_between_pixels(eye, width):
    scene = RayScene(joined(box((0, 0, 0), (8, 6, 4)), box((2, 1, 4), (5, 4, 7)), sphere(5.0)))
    points = scene.surface.triangles.reshape(-1, 3)
    view = View.framing(points, eye=eye, up=(0, 0.1, 1) if eye[0] else (1, 0, 0), pixels_per_unit=20)
    maps = render_maps(scene, view)
    plane = view.pixel_centres()
    seen = np.where(maps.mask, maps.depth, 0.0)
    space = view.to_space(np.dstack([plane, seen])).astype(np.float32)
    expected = feature_edges(maps.mask, maps.normal, space, view.pixel, width, outlines=False)
    axes = np.array([view.right, view.up, view.eye])
    found = face_edges(maps.face, maps.depth, scene.normals, axes, view.pixel, width)
    assert 0.003 < found.mean() < 0.3
    assert (found != expected).mean() < 1e-4  # depths of a step, rounded to single precision in one of them

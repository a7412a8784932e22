"""Rays: distances, faces, barycentric coordinates, crossings, holes, twins."""

import numpy as np
import pytest
from rendering_surfaces import box, joined, sphere, surface, upright

from popsim.errors import GeometryError
from popsim.rendering.ray_scene import MAX_LAYERS, RayScene

DOWN = np.array([[0.0, 0.0, -1.0]])


def test_hit_gives_distance_face_and_barycentric_coordinates():
    scene = RayScene(surface([[[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 0, -1], [4, 0, -1], [0, 4, -1]]]))
    hits = scene.hit(np.array([[1.0, 2.0, 7.0], [3.0, 3.0, 7.0]]), DOWN, bary=True)
    np.testing.assert_allclose(hits.distance, [7, np.inf])
    np.testing.assert_array_equal(hits.face, [0, -1])
    np.testing.assert_allclose(hits.bary, [[0.25, 0.25, 0.5], [0, 0, 0]], atol=1e-12)


def test_distance_is_in_units_whatever_the_length_of_the_direction():
    scene = RayScene(upright())
    assert scene.hit(np.array([[5.0, 5.0, 8.0]]), np.array([[0, 0, -13.0]])).distance[0] == pytest.approx(8)


def test_many_rays_from_inside_a_sphere_meet_it_at_its_radius():
    directions = np.random.default_rng(0).normal(size=(100_000, 3))
    hits = RayScene(sphere(50.0, steps=64)).hit(np.zeros((100_000, 3)), directions)
    assert (hits.face >= 0).all()
    assert hits.distance.max() <= 50.0 + 1e-9
    assert hits.distance.min() >= 50.0 * np.cos(np.pi / 64)


def test_bary_reconstructs_the_point_hit():
    scene = RayScene(sphere(3.0))
    directions = np.random.default_rng(3).normal(size=(500, 3))
    hits = scene.hit(np.zeros((500, 3)), directions, bary=True)
    points = np.einsum("kc,kcd->kd", hits.bary, scene.surface.triangles[hits.face])
    expected = directions / np.linalg.norm(directions, axis=1)[:, None] * hits.distance[:, None]
    np.testing.assert_allclose(points, expected, atol=2e-6)  # rays on edges are rounded in float32


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e6])
def test_precision_follows_the_size_and_not_the_place(scale):
    scene = RayScene(box(scale * np.array([1e3, 0, 0]), scale * np.array([1e3 + 1, 1, 1])))
    hit = scene.hit(scale * np.array([[1e3 + 0.3, 0.4, 5.0]]), DOWN)
    assert hit.distance[0] == pytest.approx(4 * scale, rel=1e-12)


def test_near_and_far():
    scene = RayScene(joined(*(upright(z) for z in (0.0, 1.0, 2.0, 3.0))))
    origin = np.array([[5.0, 4.0, 10.0]])
    assert scene.hit(origin, DOWN, near=7.5).distance[0] == pytest.approx(8)
    assert scene.hit(origin, DOWN, near=8.0, far=8.5).distance[0] == pytest.approx(8)
    assert scene.hit(origin, DOWN, far=6.9).face[0] == -1
    assert scene.hit(origin, DOWN, far=7.0).distance[0] == pytest.approx(7)


def test_crossings_and_thickness_of_a_box():
    scene = RayScene(joined(box([0, 0, 0], [4, 4, 2]), box([0, 0, 5], [4, 4, 6])))
    origins = np.array([[1.0, 2.0, 9.0], [9.0, 9.0, 9.0], [1.0, 3.0, 5.5]])
    crossings = scene.crossings(origins, DOWN)
    np.testing.assert_array_equal(crossings.ray, [0, 0, 0, 0, 2, 2, 2])
    np.testing.assert_allclose(crossings.distance[:4], [3, 4, 7, 9])
    np.testing.assert_allclose(scene.thickness(origins[:2], DOWN), [3, 0])


def test_crossings_on_a_shared_edge_count_once():
    diagonal = np.array([[2.0, 2.0, 9.0]])
    assert len(RayScene(box([0, 0, 0], [4, 4, 2])).crossings(diagonal, DOWN).ray) == 2


def test_no_rays_give_no_hits():
    scene = RayScene(upright())
    assert scene.hit(np.zeros((0, 3)), DOWN).distance.shape == (0,)
    assert scene.occluded(np.zeros((0, 3)), DOWN).shape == (0,)
    assert len(scene.crossings(np.zeros((0, 3)), DOWN).ray) == 0


def test_occluded_agrees_with_hit():
    scene = RayScene(sphere(1.0))
    rng = np.random.default_rng(2)
    origins, directions = rng.normal(size=(2000, 3)) * 2, rng.normal(size=(2000, 3))
    near = 2 * scene.tolerance
    np.testing.assert_array_equal(
        scene.occluded(origins, directions), scene.hit(origins, directions, near=near).face >= 0
    )


def test_rays_meet_something_where_they_hit_something():
    """Also between distances, and through holes."""
    scene = RayScene(joined(sphere(1.0), upright(0.3, low=(-1, -1), high=(1, 1), colour=[1, 1, 1, 0.2])))
    rng = np.random.default_rng(4)
    origins = rng.normal(size=(3000, 3)) * 2
    near, far = rng.uniform(0, 2, (2, 3000))
    for ends in ({}, {"near": 0.4, "far": 2.5}, {"near": near, "far": near + far}):
        for directions in (DOWN, rng.normal(size=(3000, 3))):
            met = scene.meets(origins, directions, **ends)
            assert 0.03 < met.mean() < 0.97
            np.testing.assert_array_equal(met, scene.hit(origins, directions, **ends).face >= 0)


def test_where_on_their_faces_rays_end_is_told_on_demand():
    scene = RayScene(sphere(3.0))
    directions = np.random.default_rng(5).normal(size=(500, 3))
    plain, full = (scene.hit(np.zeros((500, 3)), directions, bary=asked) for asked in (False, True))
    assert plain.bary.shape == (0, 3) and full.bary.shape == (500, 3)
    np.testing.assert_array_equal(plain.distance, full.distance)
    np.testing.assert_array_equal(plain.face, full.face)


def test_faint_colours_are_holes():
    glass = upright(1.0, colour=[1, 1, 1, 0.3])
    scene = RayScene(joined(glass, upright(0.0)))
    origin = np.array([[5.0, 4.0, 3.0]])
    assert scene.hit(origin, DOWN).distance[0] == pytest.approx(3)
    assert scene.hit(origin, DOWN, through_holes=False).distance[0] == pytest.approx(2)
    assert not scene.occluded(origin, DOWN, far=2.5)[0]


def test_nothing_is_seen_behind_too_many_holes():
    sheets = [upright(float(z), colour=[1, 1, 1, 0.0]) for z in range(1, MAX_LAYERS + 1)]
    origin = np.array([[5.0, 4.0, 100.0]])
    assert RayScene(joined(*sheets, upright())).hit(origin, DOWN).face[0] == -1
    assert RayScene(joined(*sheets[1:], upright())).hit(origin, DOWN).distance[0] == pytest.approx(100)


def test_of_twin_faces_the_one_with_its_front_to_the_ray_is_hit():
    triangle = np.array([[[0, 0, 0], [4, 0, 0], [0, 4, 0.0]]])
    scene = RayScene(surface(np.concatenate([triangle[:, ::-1], triangle])))
    above, below = np.array([[1.0, 1.0, 1.0]]), np.array([[1.0, 1.0, -1.0]])
    assert scene.hit(above, DOWN).face[0] == 1
    assert scene.hit(below, -DOWN).face[0] == 0
    assert len(scene.crossings(above, DOWN).ray) == 1


def test_a_degenerate_triangle_does_no_harm():
    line = surface([[[0, 0, 5], [5, 5, 5], [10, 10, 5]]])
    hits = RayScene(joined(line, upright())).hit(np.array([[3.0, 4.0, 9.0]]), DOWN)
    assert hits.distance[0] == pytest.approx(9)
    assert hits.face[0] in (1, 2)


def test_refusals():
    with pytest.raises(GeometryError, match="without triangles"):
        RayScene(surface(np.zeros((0, 3, 3)), uv=np.zeros((0, 3, 2))))
    scene = RayScene(upright())
    with pytest.raises(GeometryError, match="direction"):
        scene.hit(np.zeros((1, 3)), np.zeros((1, 3)))
    with pytest.raises(GeometryError, match="directions"):
        scene.hit(np.zeros((2, 3)), np.ones((3, 3)))

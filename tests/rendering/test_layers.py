"""Layers of a surface, as boxes in space."""

import time

import numpy as np
import pytest
from rendering_surfaces import box, joined, sphere, surface

from popsim.errors import GeometryError
from popsim.rendering.layers import PIXELS, Relief, layers
from popsim.rendering.ray_scene import RayScene


@pytest.fixture(scope="module")
def car():
    """A body with a bonnet in front, a cabin, and a boot behind."""
    return RayScene(joined(box((-60, -25, 0), (60, 25, 25)), box((-40, -22, 25), (20, 22, 45))))


def prism(profile, low, high):
    """The solid between two copies of a convex or notched profile (x, z) at y = low and y = high, ends open."""
    ring = np.array(profile, float)
    near, far = (np.column_stack([ring[:, 0], np.full(len(ring), y), ring[:, 1]]) for y in (low, high))
    after = np.roll(np.arange(len(ring)), -1)
    quads = np.stack([near, near[after], far[after], far], axis=1)
    return surface(np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def test_the_front_of_a_car_is_grille_and_windscreen(car):
    grille, screen = layers(car, (1, 0, 0))
    assert (grille.position, screen.position) == pytest.approx((60, 20), abs=1e-6)
    assert grille.box == pytest.approx(np.array([[60, -25, 0], [60, 25, 25]]), abs=0.5)
    assert screen.box == pytest.approx(np.array([[20, -22, 25], [20, 22, 45]]), abs=0.5)
    assert grille.area == pytest.approx(50 * 25, rel=0.03)
    assert screen.normal == pytest.approx((1, 0, 0), abs=1e-6)


def test_from_above_it_is_roof_bonnet_and_boot(car):
    found = layers(car, (0, 0, 1))
    assert sorted(round(each.position) for each in found) == [25, 45]
    roof = next(each for each in found if each.position > 40)
    assert roof.box == pytest.approx(np.array([[-40, -22, 45], [20, 22, 45]]), abs=0.5)
    assert next(each for each in found if each.position < 40).area == pytest.approx(120 * 50 - 60 * 44, rel=0.03)


def test_opposite_sides_see_their_own_layers(car):
    back = layers(car, (-1, 0, 0))
    assert [round(each.position) for each in back] == [60, 40]
    assert back[0].box[0, 0] == pytest.approx(-60)


def test_a_ball_is_one_layer():
    (ball,) = layers(RayScene(sphere(10.0)), (0, 1, 0), step=0.05, turn=0.6)
    assert ball.area == pytest.approx(np.pi * 100, rel=0.05)


BOUNDS = np.array([[-60.0, -25.0, 0.0], [60.0, 25.0, 45.0]])


@pytest.fixture(scope="module")
def relief(car):
    return Relief.of(car, BOUNDS)


def test_the_relief_of_a_car_has_the_profile_of_a_layered_box(relief):
    assert [level.at for level in relief.tops(1.0)] == pytest.approx([25, 45], abs=1e-6)
    assert [level.at for level in relief.ends(1, 1.0)] == pytest.approx([60, 20], abs=1e-6)
    assert [level.at for level in relief.ends(-1, 1.0)] == pytest.approx([-60, -40], abs=1e-6)
    roof = relief.tops(1.0)[1]
    pixel = 120 / PIXELS
    assert roof.box == pytest.approx(np.array([[-40, -22, 45], [20, 22, 45]]), abs=pixel)
    assert roof.area == pytest.approx(60 * 44, rel=0.03)


def test_layers_nearer_than_told_are_one_level(relief):
    assert len(relief.tops(19.0)) == 2
    (both,) = relief.tops(20.5)
    bonnet, roof = 120 * 50 - 60 * 44, 60 * 44
    assert both.at == pytest.approx((25 * bonnet + 45 * roof) / (bonnet + roof), rel=0.01)
    assert both.box[:, 0] == pytest.approx([-60, 60], abs=1)
    assert [layer.position for layer in both.layers] == pytest.approx([25, 45], abs=1e-6)


def test_what_lies_outside_the_bounds_is_not_seen(car):
    low = BOUNDS.copy()
    low[1, 2] = 30.0
    assert [level.at for level in Relief.of(car, low).tops(1.0)] == pytest.approx([25], abs=1e-6)


def test_a_slanted_windscreen_tells_from_where_to_where_it_leans():
    profile = [(-50, 0), (50, 0), (50, 20), (30, 20), (10, 40), (-50, 40)]
    surface = prism(profile, -20.0, 20.0)
    front = Relief.of(RayScene(surface), surface.bounds).front
    screen = next(layer for layer in front if layer.normal[2] > 0.5)
    assert screen.normal == pytest.approx((0.5**0.5, 0, 0.5**0.5), abs=1e-6)
    assert screen.box[:, 0] == pytest.approx([10, 30], abs=1.5)
    assert screen.box[:, 2] == pytest.approx([20, 40], abs=1.5)
    assert screen.position == pytest.approx(20, abs=1)


def test_three_views_in_a_tenth_of_a_second_of_work(car):
    spent = []
    for _ in range(3):
        start = time.process_time()
        Relief.of(car, BOUNDS)
        spent.append(time.process_time() - start)
    assert min(spent) < 0.1


def test_a_box_has_two_ends(relief):
    with pytest.raises(GeometryError, match="sign 1"):
        relief.ends(0, 1.0)

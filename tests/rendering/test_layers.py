"""Layers of a surface, as boxes in space."""

import numpy as np
import pytest
from rendering_surfaces import box, joined, sphere

from popsim.rendering.layers import layers
from popsim.rendering.ray_scene import RayScene


@pytest.fixture(scope="module")
def car():
    """A body with a bonnet in front, a cabin, and a boot behind."""
    return RayScene(joined(box((-60, -25, 0), (60, 25, 25)), box((-40, -22, 25), (20, 22, 45))))


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

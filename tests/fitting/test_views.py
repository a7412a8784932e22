"""Views of the card: where their pixels meet a plane, and what the model's fronts say of points on it."""

import numpy as np
import pytest
from fitting_surfaces import block, surface

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.fronts import Fronts
from popsim.fitting.views import PIXELS, Views, view_directions
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 40.0]])
SCENE = RayScene(surface(block(tuple(BOUNDS[0]), tuple(BOUNDS[1]))))


def test_pixels_meet_a_plane_where_their_rays_do():
    views = Views.of(BOUNDS)
    normal = np.array([0.6, 0.0, 0.8])
    corners = np.array([[40, -20, 10], [40, 20, 10], [-40, 20, 70], [-40, -20, 70.0]])
    pixels, points, depth = views.cast(corners, normal)
    origins, directions = views.rays()
    assert np.abs((points - corners[0]) @ normal).max() < 1e-9
    assert np.abs(origins[pixels] + depth[:, None] * directions[pixels] - points).max() < 1e-9


def test_a_plane_seen_edge_on_has_no_pixels():
    _, up = Views.of(BOUNDS).shape, np.array([0.0, 0.0, 1.0])
    pixels, _, _ = Views.of(BOUNDS).cast(np.array([[0, 0, 5], [9, 0, 5], [9, 9, 5.0]]), up)
    level = [k for k, eye in enumerate(view_directions()) if eye[2] == 0]
    assert not np.isin(pixels // PIXELS**2, level).any()


@pytest.mark.parametrize("outward", [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]])
def test_fronts_tell_how_far_behind_a_point_the_model_lies(outward):
    outward = np.array(outward, float)
    face = BOUNDS.mean(axis=0) + outward * (BOUNDS[1] - BOUNDS[0]) / 2
    behind = Fronts.of(SCENE, BOUNDS).behind(np.array([face + 7 * outward, face - 2 * outward]), outward)
    assert behind == pytest.approx([7.0, -2.0], abs=1e-3)


def test_the_box_of_a_box_is_all_like_it_and_a_smaller_one_is_less():
    seen = Appearance(SCENE, BOUNDS)
    pair = card_pair(Card(x=(-300, 300), depth=300))
    right = seen.likeness([BoxFold.plain("M1", pair, 30.0, 40.0, (-50.0, 50.0))])
    assert right.silhouette > 0.99 and right.relief > 0.99 and right.offset < 0.01
    small = seen.likeness([BoxFold.plain("M1", pair, 20.0, 30.0, (-40.0, 40.0))])
    assert small.silhouette < right.silhouette - 0.1 and small.overall < right.overall


def test_what_hangs_in_the_air_beside_a_face_does_not_count():
    box = BoxFold.plain("M1", card_pair(Card(x=(-300, 300), depth=300)), 30.0, 40.0, (-50.0, 50.0))
    bounds = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 60.0]])

    def with_wall(low, high):
        scene = RayScene(surface(block(tuple(BOUNDS[0]), tuple(BOUNDS[1])), block((-20, 26, low), (20, 30, high))))
        return Appearance(scene, bounds).likeness([box]).silhouette

    assert with_wall(40, 60) > with_wall(50, 60) + 0.01

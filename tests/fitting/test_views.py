"""Views of the card: where their pixels meet a plane, and what the model's fronts say of points on it."""

import numpy as np
import pytest
from fitting_surfaces import block, painted, surface

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.fronts import Fronts
from popsim.fitting.slant import Slant
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import PIXELS, Views, view_directions
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 40.0]])
SCENE = RayScene(surface(block(tuple(BOUNDS[0]), tuple(BOUNDS[1]))))


SLOPE = Slant.of(np.array([0.6, 0.0, 0.8]), np.array([40.0, 0.0, 10.0]))


def whole(slant):
    """All of a plane over a square of 40 mm."""
    every = np.ones((40, 40), dtype=bool)
    return Stencil(slant, np.array([-20.0, -20.0]), np.array([1.0, 1.0]), every, every)


def pixels_and_depths(views, stencil):
    """Pixels of all views in which a stencil shows, in the order of their rays, and how far it is in them."""
    depth = painted(views, [views.drawn(stencil)])
    pixels = np.flatnonzero(np.isfinite(depth))
    return pixels, depth.ravel()[pixels]


def test_a_slant_names_the_points_of_its_plane_by_two_coordinates():
    points = np.array([[40.0, -20, 10], [40, 20, 10], [-40, 20, 70]])
    assert SLOPE.axis == 2 and SLOPE.sign == 1
    assert SLOPE.along(*SLOPE.seen(points).T) == pytest.approx(points[:, 2])
    assert (points - [40, 0, 10]) @ SLOPE.equation == pytest.approx([0, 0, 0])


def test_pixels_see_a_stencil_where_their_rays_meet_its_plane():
    views = Views.of(BOUNDS)
    pixels, depth = pixels_and_depths(views, whole(SLOPE))
    origins, directions = views.rays()
    points = origins[pixels] + depth[:, None] * directions[pixels]
    assert np.abs((points - [40, 0, 10]) @ SLOPE.equation).max() < 1e-4  # depths are kept in single precision
    assert np.abs(points[:, :2]).max() < 20.01
    rays = directions @ SLOPE.equation
    meets = (
        origins
        - (((origins - [40, 0, 10]) @ SLOPE.equation) / np.where(rays == 0, np.nan, rays))[:, None] * directions
    )
    sees = np.flatnonzero((np.abs(meets[:, :2]) < 19.99).all(axis=1))
    assert set(sees) <= set(pixels.tolist())


def test_a_plane_seen_edge_on_has_no_pixels():
    lying = whole(Slant.of(np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, 5.0])))
    pixels, _ = pixels_and_depths(Views.of(BOUNDS), lying)
    level = [k for k, eye in enumerate(view_directions()) if eye[2] == 0]
    assert len(pixels) and not np.isin(pixels // PIXELS**2, level).any()


@pytest.mark.parametrize(("axis", "sign"), [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1)])
def test_fronts_tell_how_far_out_the_model_reaches(axis, sign):
    ends = Fronts.of(SCENE, BOUNDS, 1.0).ends(axis, sign)
    middle, edge = np.array(ends.near.shape) // 2, (ends.near[0, 0], ends.near[-1, -1])
    assert ends.near[tuple(middle)] == pytest.approx(sign * BOUNDS[int(sign > 0), axis], abs=1e-3)
    assert ends.far[tuple(middle)] == pytest.approx(-sign * BOUNDS[int(sign < 0), axis], abs=1e-3)
    assert edge == (-np.inf, -np.inf) and ends.sign == sign


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

"""Models that are the same on both sides of the fold are looked at from one side only, to the same effect."""

from dataclasses import replace

import numpy as np
import pytest
from fitting_surfaces import block, surface

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.fronts import Fronts
from popsim.fitting.mirror import Mirror, lies_beyond, mirrored, same_on_both_sides, shape_of
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import Views
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 40.0]])
EVEN = (block((-50, -30, 0), (50, 30, 22)), block((-20, -18, 20), (30, 18, 40)))
PIPE = block((-44, 22, 20), (-36, 30, 36))
PLATES = BoxFold.plain("M", card_pair(Card(x=(-80.0, 80.0), depth=90.0)), 28.0, 37.0, (-47.0, 41.0)).plates()
ROLES = [plate.role for plate in PLATES]


def scene(*parts) -> RayScene:
    return RayScene(surface(*parts))


def drawn(views: Views, pictures) -> np.ndarray:
    depth = np.full((len(views.axes), views.pixels, views.pixels), np.inf)
    for view, rows, columns, there in pictures:
        depth[view, rows, columns] = there
    return depth


def test_what_stands_on_one_side_only_is_noticed():
    assert same_on_both_sides(Fronts.of(scene(*EVEN), BOUNDS, 0.7))
    assert not same_on_both_sides(Fronts.of(scene(*EVEN, PIPE), BOUNDS, 0.7))


def test_a_box_beside_the_fold_is_not_the_same_on_both_sides():
    assert not same_on_both_sides(Fronts.of(scene(*EVEN), BOUNDS + np.array([0, 0.1, 0]), 0.7))


@pytest.mark.parametrize("role", ROLES)
def test_the_image_of_a_picture_is_the_picture_of_the_image(role):
    """But for pixels at borders, which see a stencil whose cells begin at its other end."""
    views = Views.of(BOUNDS)
    fronts = Fronts.of(scene(*EVEN), BOUNDS, 0.7)
    plate = PLATES[ROLES.index(role)]
    image = drawn(views, Mirror.of(views).image(views.drawn(Stencil.of(plate, fronts))))
    other = drawn(views, views.drawn(Stencil.of(mirrored(plate), fronts)))
    shown, also = np.isfinite(image), np.isfinite(other)
    assert (shown != also).sum() <= 0.02 * max(shown.sum(), 1)
    both = shown & also
    assert both.any() and np.abs(image[both] - other[both]).max() < 1e-3


def test_both_sides_of_a_box_are_seen_at_the_cost_of_one():
    appearance = Appearance(scene(*EVEN), BOUNDS)
    sides = [plate for plate in PLATES if plate.outline[:, 1].any()]
    assert {lies_beyond(plate) for plate in sides} == {True, False}
    for plate in sides:
        appearance._picture(plate)
    assert len(appearance.known) == len(sides) / 2


def test_a_likeness_is_nearly_that_of_looking_at_both_sides(monkeypatch):
    box = BoxFold.plain("M", card_pair(Card(x=(-80.0, 80.0), depth=90.0)), 28.0, 37.0, (-47.0, 41.0))
    one = Appearance(scene(*EVEN), BOUNDS).likeness([box])
    monkeypatch.setattr("popsim.fitting.appearance.same_on_both_sides", lambda fronts: False)
    both = Appearance(scene(*EVEN), BOUNDS).likeness([box])
    assert one.silhouette == pytest.approx(both.silhouette, abs=2e-3)
    assert one.relief == pytest.approx(both.relief, abs=2e-3)


def test_a_shape_does_not_depend_on_how_its_corners_are_listed():
    plate = next(plate for plate in PLATES if len(plate.room) > 3)
    listed = replace(plate, outline=np.roll(plate.outline[::-1], 2, axis=0), room=np.roll(plate.room, 1, axis=0))
    assert shape_of(listed, across=False) == shape_of(plate, across=False)
    assert shape_of(mirrored(plate), across=True) == shape_of(plate, across=False)
    for other in (
        replace(plate, outline=plate.outline + np.array([0.01, 0, 0])),
        replace(plate, behind=plate.behind + 1),
    ):
        assert shape_of(other, across=False) != shape_of(plate, across=False)

"""Models that are the same on both sides of the fold are looked at from one side only, to the same effect."""

from dataclasses import replace

import numpy as np
import pytest
from fitting_surfaces import block, painted, surface

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.drawing import Drawing
from popsim.fitting.fronts import Fronts
from popsim.fitting.mirror import Mirror, Sides, lies_beyond, same_on_both_sides
from popsim.fitting.shape import ACROSS, shape_of
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import Views
from popsim.mechanisms import card_pair, plates_of, plates_together
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.plate import hinged
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 40.0]])
EVEN = (block((-50, -30, 0), (50, 30, 22)), block((-20, -18, 20), (30, 18, 40)))
PIPE = block((-44, 22, 20), (-36, 30, 36))
BOX = BoxFold.plain("M", card_pair(Card(x=(-80.0, 80.0), depth=90.0)), 28.0, 37.0, (-47.0, 41.0))
PLATES = BOX.plates()
ROLES = [plate.role for plate in PLATES]


def scene(*parts) -> RayScene:
    return RayScene(surface(*parts))


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
    near, far = (views.drawn(Stencil.of(shape_of(plate, across=across), fronts)) for across in (False, True))
    image, other = painted(views, [Mirror.of(views).image(near)]), painted(views, [far])
    shown, also = np.isfinite(image), np.isfinite(other)
    assert (shown != also).sum() <= 0.02 * max(shown.sum(), 1)
    both = shown & also
    assert both.any() and np.abs(image[both] - other[both]).max() < 1e-3


def test_both_sides_of_a_box_are_seen_at_the_cost_of_one():
    drawing = Drawing(Views.of(BOUNDS), Fronts.of(scene(*EVEN), BOUNDS, 0.7))
    sides = [plate for plate in PLATES if plate.outline[:, 1].any()]
    assert {lies_beyond(plate) for plate in sides} == {True, False}
    for plate in sides:
        drawing.picture(plate)
    assert len(drawing.plates) == len(sides) / 2


def test_of_a_box_on_the_fold_only_the_near_side_is_drawn():
    together = plates_together([BOX])["M"]
    own = Sides.of(together, even=True)
    assert own.even and {plate.role for plate in own.plates} == {"L", "C", "T_G", "B_L", "F_L"}
    assert not Sides.of(together, even=False).even
    deeper = plates_together([BOX], {"M.R": (2.0, 1.0)})["M"]
    assert not Sides.of(deeper, even=True).even and Sides.of(deeper, even=True).plates == deeper


@pytest.mark.parametrize("depths", [{}, {"M.R": (3.0, 1.0)}])
def test_asked_again_a_mechanism_is_drawn_the_same(depths):
    drawing = Drawing(Views.of(BOUNDS), Fronts.of(scene(*EVEN), BOUNDS, 0.7))
    first, *later = (drawing.drawn([BOX], depths) for _ in range(3))
    assert len(drawing.wholes) == 1 and first[1] is not bool(depths)
    for depth, half in later:
        assert half == first[1] and np.array_equal(depth, first[0])


def test_of_what_is_alike_on_both_sides_half_of_the_views_tell_all():
    views, fronts = Views.of(BOUNDS), Fronts.of(scene(block((-47, -28, 0), (41, 28, 37))), BOUNDS, 0.7)
    mirror = Mirror.of(views)
    depth, half = Drawing(views, fronts).drawn([BOX], {})
    assert half and len(depth) == len(mirror.once) < len(views.axes)
    assert mirror.weights.sum() == len(views.axes)
    near = Sides.of(plates_together([BOX])["M"], even=True).plates
    pictures = [views.drawn(Stencil.of(shape_of(plate, across=False), fronts)) for plate in near]
    whole = painted(views, [*pictures, *map(mirror.image, pictures)])
    assert np.array_equal(depth, whole[mirror.once])


def test_a_likeness_is_nearly_that_of_looking_at_both_sides(monkeypatch):
    one = Appearance(scene(*EVEN), BOUNDS).likeness([BOX])
    monkeypatch.setattr("popsim.fitting.drawing.same_on_both_sides", lambda fronts: False)
    both = Appearance(scene(*EVEN), BOUNDS).likeness([BOX])
    assert one.silhouette == pytest.approx(both.silhouette, abs=2e-3)
    assert one.relief == pytest.approx(both.relief, abs=2e-3)


def test_plates_have_their_hinges_in_one_order_however_joints_are_listed():
    joints = [replace(joint, axis=joint.axis[::-1]) for joint in BOX.joints()[::-1]]
    for plate, other in zip(hinged(PLATES, BOX.joints()), hinged(PLATES, joints), strict=True):
        assert len(plate.hinges) and np.array_equal(plate.hinges, other.hinges)


def test_a_shape_tells_a_plate_from_others_and_its_mirror_image():
    plate = next(plate for plate in plates_of(BOX) if len(plate.hinges) > 2)
    own = shape_of(plate, across=False)
    image, back = shape_of(plate, across=True), plate.but(outline=plate.outline * ACROSS, room=plate.room * ACROSS)
    back = back.but(outward=plate.outward * ACROSS, hinges=plate.hinges * ACROSS)
    assert shape_of(back, across=True).key == own.key != image.key == shape_of(back, across=False).key
    for other in (
        plate.but(outline=plate.outline + np.array([0.01, 0, 0])),
        plate.but(behind=plate.behind + 1),
        plate.but(taken=[[0.0, 1.0, 50.0]]),
    ):
        assert shape_of(other, across=False).key != own.key

"""Stencils show on a plate what its contours will leave of it."""

import numpy as np
import pytest
from fitting_surfaces import block, surface
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from scipy.ndimage import binary_dilation, label

from popsim.design import Card
from popsim.fitting.fronts import Fronts
from popsim.fitting.kernels.cells import grown, grown_by, reached, square_around, within
from popsim.fitting.shape import shape_of
from popsim.fitting.stencil import Stencil
from popsim.mechanisms import card_pair, plates_of
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings
from popsim.patches.cut import cut
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 60.0]])
BOX = BoxFold.plain("M1", card_pair(Card(x=(-300, 300), depth=300)), 30.0, 40.0, (-50.0, 50.0))
BODY = block((-50, -30, 0), (50, 30, 40))


def stencil_of(role, *parts):
    plate = next(plate for plate in plates_of(BOX) if plate.role == role)
    return Stencil.of(shape_of(plate, across=False), Fronts.of(RayScene(surface(*parts)), BOUNDS, 1.0))


def shows(role, points, *parts):
    stencil = stencil_of(role, *parts)
    cells = (stencil.slant.seen(np.array(points, float)) - stencil.low) / stencil.grain
    return [bool(stencil.mask[x, y]) for x, y in np.floor(cells).astype(int)]


def test_a_side_shows_all_of_a_box_and_nothing_over_it():
    assert shows("L", [(0, 30, 20), (49, 30, 39), (-49, 30, 1), (0, 30, 45)], BODY) == [True, True, True, False]


def test_what_rises_near_its_plane_shows_unless_it_hangs_in_the_air():
    over = [(0, 30, 50)]
    assert shows("L", over, BODY, block((-20, 26, 40), (20, 30, 60))) == [True]
    assert shows("L", over, BODY, block((-20, 26, 46), (20, 30, 60))) == [False]
    assert shows("L", over, BODY, block((-20, -30, 40), (20, -20, 60))) == [False]


def test_a_seam_along_the_face_does_not_show():
    kerb = block((-50, 26, 40), (50, 30, 41.2))
    assert shows("L", [(0, 30, 40.6)], BODY, kerb) == [False]


@pytest.mark.parametrize(
    "taken", [[(-20, 10, 44)], [(-60, -10, 44), (20, 60, 52)], [(-30, 0, 50), (-10, 20, 44)], [(-70, 70, 40)]]
)
@pytest.mark.parametrize("role", ["L", "C"])
def test_what_others_take_is_left_out_as_where_contours_are_cut(role, taken):
    fronts = Fronts.of(RayScene(surface(BODY, block((-45, -30, 40), (45, 30, 60)))), BOUNDS, 1.0)
    plate = next(plate for plate in plates_of(BOX) if plate.role == role).but(taken=np.array(taken, float))
    own, cut_off = (
        Stencil.of(shape_of(each, across=False), fronts)
        for each in (plate, plate.but(room=plate.left, taken=np.zeros((0, 3))))
    )
    assert own.mask.any() and np.array_equal(places(own), places(cut_off))


def places(stencil):
    """Centres of the cells that show something."""
    return (stencil.low + (np.argwhere(stencil.mask) + 0.5) * stencil.grain).round(6)


def doorway(x0, x1, z1):
    """A box with a deep recess in its near side, open to that side."""
    walls = [block((-50, -30, 0), (50, -20, 40)), block((-50, -20, 0), (x0, 30, 40))]
    return [*walls, block((x1, -20, 0), (50, 30, 40)), block((x0, -20, z1), (x1, 30, 40))]


def test_a_doorway_is_a_dent_of_its_wall_and_a_gap_between_two_walls_is_none():
    assert shows("L", [(0, 30, 10), (40, 30, 10)], *doorway(-10, 10, 30)) == [True, True]
    assert shows("L", [(0, 30, 10), (40, 30, 10)], *doorway(-10, 10, 39.9)[:3]) == [False, True]


def test_what_is_all_but_empty_stays_whole():
    corner = block((-50, -30, 0), (-47, 30, 40))
    assert shows("L", [(-48, 30, 20), (0, 30, 20)], corner) == [True, True]


TABLE = [block((-50, -30, 30), (50, 30, 40)), block((-5, -5, 0), (5, 5, 30))]


def test_a_strip_reaches_for_a_hinge_where_the_model_does_not():
    """A fourth of the line holds it, beside what reaches it already."""
    foot = [(x, 30, 15) for x in (-40, -18, -9, 0, 9, 18)]
    assert shows("L", foot, *TABLE) == [False, False, True, True, True, False]
    assert shows("L", [(-40, 30, 15)], *TABLE, block((0, 20, 0), (30, 30, 30))) == [False]


SLAB = [block((-50, -30, 36), (50, 30, 40)), block((-1, -1, 0), (1, 1, 36))]


@pytest.mark.parametrize("parts", [TABLE, SLAB])
def test_strips_are_those_that_patches_have(parts):
    """Also where a face shows but the edge of a slab along an upright hinge: a strip goes all across it."""
    scene = RayScene(surface(*parts))
    cuts = cut([BOX], scene, {"M1": BOUNDS}, PatchSettings())
    for role in ("L", "R", "F_L", "B_R", "T_G"):
        mask = stencil_of(role, *parts).mask
        assert mask.sum() == pytest.approx(cuts.outlines[f"M1.{role}"].area, rel=0.03)


def test_a_backbone_shows_what_either_side_hides_unless_one_sees_through():
    tunnel = [block((-50, -30, 0), (-15, 30, 40)), block((15, -30, 0), (50, 30, 40))]
    tunnel += [block((-15, -30, 30), (15, 30, 40)), block((-15, -30, 0), (15, 30, 5))]
    assert shows("C", [(0, 0, 15), (30, 0, 15)], *tunnel) == [False, True]


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_points_lie_within_rectangles_and_others_alike(turn):
    ring = np.array([[-4, -2], [4, -2], [4, 2], [-4, 2.0]])
    matrix = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    s, t = (np.sort(values) for values in np.random.default_rng(1).uniform(-6, 6, (2, 60)))
    points = np.stack(np.meshgrid(s, t, indexing="ij"), axis=-1)
    inside = (np.abs(points @ matrix.T) < [4, 2]).all(axis=-1)
    assert (within(s, t, ring @ matrix) == inside).all() and 0 < inside.sum() < inside.size


@given(arrays(bool, array_shapes(min_dims=2, max_dims=2, max_side=9)), st.integers(0, 3))
def test_masks_grow_and_fill_as_scipy_has_it(mask, steps):
    assert (grown(mask) == binary_dilation(mask)).all()
    assert (grown_by(mask, steps) == (binary_dilation(mask, iterations=steps) if steps else mask)).all()
    square = binary_dilation(mask, np.ones((2 * steps + 1, 2 * steps + 1)))
    assert (square_around(mask, steps) == square).all()


@given(arrays(bool, (7, 9)), arrays(bool, (7, 9)))
def test_what_hangs_together_with_seeds_is_what_scipy_labels_so(free, seeds):
    labels = label(free)[0]
    assert (reached(free, seeds) == (free & np.isin(labels, labels[seeds & free]))).all()


BONNET = block((-50, -30, 10), (50, 30, 40))
AXLE_HEIGHT = [(50, 25, 5), (50, 25, 25)]


def wheels(front):
    """A wheel at each side whose front lies at some x."""
    return [block((front - 12, side, 0), (front, side + 10, 10)) for side in (-30, 20)]


@pytest.mark.parametrize(("front", "shown"), [(34, False), (41, True)])
def test_wheels_show_on_a_front_unless_they_stand_back_as_legs_do(front, shown):
    """As contours have it: see the patches of the same body."""
    assert shows("F_L", AXLE_HEIGHT, BONNET, *wheels(front)) == [shown, True]


def test_wheels_show_on_the_sides_wherever_they_stand():
    assert shows("L", [(28, 30, 5)], BONNET, *wheels(34)) == [True]


def test_a_wall_beneath_a_projecting_storey_is_no_leg():
    assert shows("F_L", AXLE_HEIGHT, BONNET, block((-50, -30, 0), (41, 30, 10))) == [True, True]

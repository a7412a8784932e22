"""The pop-up as a surface looks like the model it was made from."""

import numpy as np
import pytest
from patch_solids import box_of, coloured_box

from popsim.design import Card
from popsim.errors import InputError
from popsim.geometry.surface import Material, Surface
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings, paint
from popsim.patches.popup_surface import PAPER, popup_surface
from popsim.rendering.maps import render_maps
from popsim.rendering.view import View
from popsim.validity import examine

CARD = Card(x=(-150, 150), depth=200)
VIEWS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (1, 1, 0.8), (-1, 1, 0.8)]


def chequered(low, high):
    """A box with a chequered, graded picture on every side."""
    plain = coloured_box(low, high)
    row, column = np.indices((64, 64))
    bright = np.where((row // 8 + column // 8) % 2, 230, 60)
    image = np.dstack([bright, row * 3, column * 3, np.full_like(row, 255)]).astype(np.uint8)
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    uv = np.array([corners[list(half)] for half in ((0, 1, 2), (0, 2, 3))] * 6)
    return Surface(plain.triangles, uv, np.zeros(12, int), (Material(np.ones(4), image),))


@pytest.fixture(scope="module")
def pair():
    """A chequered box, and its pop-up with the images of it."""
    model = chequered((-50, -30, 0), (50, 30, 40))
    box = BoxFold.plain("M1", card_pair(CARD), 30, 40, (-50, 50))
    painted = paint([box], model, {"M1": box_of(model)}, PatchSettings(dpi=150))
    return model, assemble(CARD, [box], painted.shapes), painted.images


@pytest.mark.parametrize("eye", VIEWS)
def test_prints_lie_where_the_model_has_them(pair, eye):
    model, design, images = pair
    up = (1, 0, 0) if eye == (0, 0, 1) else (0, 0, 1)
    view = View.framing(model.triangles.reshape(-1, 3), eye=eye, up=up, pixels_per_unit=4)
    one = render_maps(model, view, shading="flat")
    two = render_maps(popup_surface(design, images, pages=False), view, shading="flat")
    both = one.mask & two.mask
    assert both.sum() / (one.mask | two.mask).sum() > 0.98
    difference = np.abs(one.colour[both, :3].astype(float) - two.colour[both, :3]) / 255
    assert difference.mean() < 0.03


def test_the_reverse_is_bare_paper(pair):
    _, design, images = pair
    inside = View(np.array([0, 1.0, 0]), np.array([0, 0, 1.0]), np.array([0, -15.0, 0]), (-20, 5), (40, 30), 2)
    maps = render_maps(popup_surface(design, images, pages=False), inside, near=0, shading="flat")
    assert maps.mask.all()
    assert np.abs(maps.colour[..., :3] / 255.0 - PAPER.colour[:3]).max() < 0.01


def test_poses_fold_it(pair):
    _, design, images = pair
    poses = {name: motion[0] for name, motion in examine(design).poses(np.array([0.0])).items()}
    flat = popup_surface(design, images, poses)
    assert np.abs(flat.triangles[..., 1]).max() < 1e-9
    assert np.ptp(flat.triangles[..., 2]) == pytest.approx(200)


def test_pages_can_be_left_out_and_areas_are_kept(pair):
    _, design, images = pair
    surface = popup_surface(design, images, pages=False)
    edges = surface.triangles[:, 1:] - surface.triangles[:, :1]
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2
    expected = sum(patch.plane.polygon(patch.points).area for patch in design.popup_patches)
    assert area == pytest.approx(2 * expected, rel=1e-9)
    assert len(popup_surface(design, images).triangles) == len(surface.triangles) + 8


def test_missing_and_broken_textures_are_named(pair, tmp_path):
    _, design, images = pair
    with pytest.raises(InputError, match=r"textures/M1\.L\.png"):
        popup_surface(design, tmp_path)
    with pytest.raises(InputError, match="not among the images"):
        popup_surface(design, {})
    with pytest.raises(InputError, match="not an image"):
        popup_surface(design, dict.fromkeys(images, b"no picture"))


def test_the_reverse_has_the_colour_of_the_card(pair):
    _, design, images = pair
    blue = design.model_copy(update={"card": design.card.model_copy(update={"reverse": "#204080"})})
    inside = View(np.array([0, 1.0, 0]), np.array([0, 0, 1.0]), np.array([0, -15.0, 0]), (-20, 5), (40, 30), 2)
    maps = render_maps(popup_surface(blue, images, pages=False), inside, near=0, shading="flat")
    assert (maps.colour[..., :3] == (32, 64, 128)).all()

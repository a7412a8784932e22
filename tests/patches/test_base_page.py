"""Ground and backdrop show where things stand, or what lies there."""

from io import BytesIO

import numpy as np
import pytest
from patch_solids import CYAN, coloured_box, joined
from PIL import Image

from popsim.design import BACKDROP_ID, GROUND_ID, Card
from popsim.errors import InputError
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings, paint
from popsim.patches.base_page import base_prints, footprint
from popsim.patches.paint import with_base
from popsim.patches.popup_surface import PAPER, popup_surface
from popsim.rendering.maps import render_maps
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.view import View

CARD = Card(x=(-100, 100), depth=90)
BOX = BoxFold.plain("M1", card_pair(CARD), 30, 40, (-50, 50))
HOUSE = coloured_box((-50, -30, 0), (50, 30, 40))
GARDEN = joined(HOUSE, coloured_box((-80, -60, 0), (80, 60, 1)))


def seen_from_above(surface, base):
    """Colours of the open card from above, 4 pixels per mm, as a function of x and y."""
    settings = PatchSettings(dpi=75, base=base)
    painted = paint([BOX], surface, {"M1": surface.bounds}, settings)
    painted = with_base(painted, base_prints(RayScene(surface), CARD, [BOX], settings), CARD)
    design = assemble(CARD, [BOX], painted.shapes)
    view = View(np.array([0, 0, 1.0]), np.array([0, 1.0, 0]), np.array([0, 0, 90.0]), (-100, -90), (200, 180), 4)
    maps = render_maps(popup_surface(design, painted.images), view, shading="flat")
    return lambda x, y: maps.colour[int(4 * (90 - y)), int(4 * (x + 100)), :3] / 255.0


def test_the_footprint_is_what_stands_on_the_pages():
    assert footprint([BOX]).bounds == pytest.approx((-50, -30, 50, 30))
    assert footprint([BOX]).area == pytest.approx(6000)


def test_an_outline_runs_around_the_footprint():
    at = seen_from_above(HOUSE, "outline")
    paper = PAPER.colour[:3]
    for spot in [(-80, 0), (80, 80), (0, -60)]:
        assert at(*spot) == pytest.approx(paper, abs=0.01)
    line = [at(-50.1, y) for y in (10.0, -10.0)] + [at(x, 30.1) for x in (-20.0, 20.0)]
    assert all((colour < 0.92 * paper).all() for colour in line)


def test_a_garden_is_printed_where_it_lies_and_a_shadow_around_the_house():
    at = seen_from_above(GARDEN, "print")
    assert at(-70, 50) == pytest.approx(CYAN[:3] * PAPER.colour[:3], abs=0.02)
    assert at(95, 85) == pytest.approx(PAPER.colour[:3], abs=0.01)
    near, far = at(-51, 0), at(-70, 0)
    assert near[2] < 0.95 * far[2]


def test_bare_pages_have_no_print():
    assert base_prints(RayScene(HOUSE), CARD, [BOX], PatchSettings(base="none")) == {}


def test_pages_have_colour_beyond_their_cut():
    for name, each in base_prints(RayScene(GARDEN), CARD, [BOX], PatchSettings(dpi=75)).items():
        low = np.array(each.frame.origin)
        high = low + each.frame.right + each.frame.up
        depth = (0, 90) if name == GROUND_ID else (-90, 0)
        assert low[:2] == pytest.approx((-101.5, depth[0] - 1.5))
        assert (high[:2] >= (101.5, depth[1] + 1.5)).all()
        assert name in (GROUND_ID, BACKDROP_ID)
        assert Image.open(BytesIO(each.png)).mode == "RGB"


def test_an_unknown_base_is_refused():
    with pytest.raises(InputError, match="none, outline, print"):
        PatchSettings(base="grass")

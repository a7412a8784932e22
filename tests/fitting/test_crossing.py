"""Of two plates that both reach beyond their hinge the same one ends there as when contours are cut."""

import numpy as np
import pytest
from fitting_surfaces import block, painted, surface

from popsim.design import Card
from popsim.fitting.crossing import crossed, overhangs, without
from popsim.fitting.drawing import Drawing
from popsim.fitting.fronts import Fronts
from popsim.fitting.shape import shape_of
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import Views
from popsim.mechanisms import card_pair, plates_of
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings
from popsim.patches.cut import cut
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-50.0, -50.0, 0.0], [70.0, 50.0, 40.0]])
BOX = BoxFold.plain("M1", card_pair(Card(x=(-300, 300), depth=300)), 30.0, 40.0, (-50.0, 50.0))
BODY = block((-50, -30, 0), (50, 30, 40))
ROLES = ("L", "F_L")


def fins(along, across, foot=0.0):
    """A body with a fin in the plane of its near side, so long, and one in that of its front."""
    parts = [BODY]
    if along:
        parts.append(block((50, 27, 0), (50 + along, 30, 40)))
    if across:
        parts.append(block((47, 30, foot), (50, 30 + across, 40)))
    return RayScene(surface(*parts))


def stencils(scene):
    found = {plate.role: shape_of(plate, across=False) for plate in plates_of(BOX)}
    plates = [found[role] for role in ROLES]
    return plates, [Stencil.of(plate, Fronts.of(scene, BOUNDS, 1.0)) for plate in plates]


def bands(scene):
    return crossed([overhangs(*pair) for pair in zip(*stencils(scene), strict=True)])


@pytest.mark.parametrize(("along", "across", "loser"), [(16, 10, "F_L"), (6, 14, "L")])
def test_what_reaches_less_far_ends_at_the_hinge_as_in_patches(along, across, loser):
    scene = fins(along, across)
    lost = bands(scene)
    assert [ROLES[place] for place in lost] == [loser]
    cuts = cut([BOX], scene, {"M1": BOUNDS}, PatchSettings())
    for place, whole in enumerate(stencils(scene)[1]):
        left = without(whole, lost.get(place, ()))
        assert left.mask[whole.face].sum() == whole.mask[whole.face].sum()
        assert left.mask.sum() == pytest.approx(cuts.outlines[f"M1.{ROLES[place]}"].area, rel=0.03)
        assert (left.mask.sum() < whole.mask.sum()) == (ROLES[place] == loser)


@pytest.mark.parametrize(("along", "across"), [(16, 0), (0, 10), (0, 0)])
def test_alone_beyond_a_hinge_a_plate_goes_on(along, across):
    assert not bands(fins(along, across))


def test_only_where_both_go_on_one_of_them_ends():
    """The front's fin begins half way up: below that the side's goes on."""
    scene = fins(4, 14, foot=20.0)
    ((place, ((along, first, last, _, above),)),) = bands(scene).items()
    side = stencils(scene)[1][place]
    assert ROLES[place] == "L" and along == 1 and not above
    low, high = (side.low[1] + end * side.grain[1] for end in (first, last))
    assert (low, high) == pytest.approx((20, 40), abs=1.5)


def test_what_is_drawn_ends_there_too():
    scene, views = fins(16, 10), Views.of(BOUNDS)
    drawing = Drawing(views, Fronts.of(scene, BOUNDS, 1.0))
    assert drawing.mirror is None
    depth, _ = drawing.drawn([BOX], {})
    bare = painted(views, [drawing.picture(plate) for plate in plates_of(BOX)])
    fewer = np.isfinite(bare).sum(axis=(1, 2)) - np.isfinite(depth).sum(axis=(1, 2))
    whole = stencils(scene)[1][1]
    ear = whole.mask.sum() - without(whole, bands(scene)[1]).mask.sum()
    assert fewer[0] == pytest.approx(ear * (views.pixels / views.diagonal) ** 2, rel=0.1) and fewer.min() >= 0

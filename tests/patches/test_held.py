"""A hinge that is given more paper has strips on more of its line."""

import numpy as np
import pytest
from patch_solids import coloured_box, joined

from popsim.design import Card
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings
from popsim.patches.cut import cut
from popsim.rendering.ray_scene import RayScene

TABLE = RayScene(joined(coloured_box((-50, -30, 30), (50, 30, 40)), coloured_box((-5, -5, 0), (5, 5, 30))))
BOX = BoxFold.plain("M1", card_pair(Card(x=(-300, 300), depth=300)), 30.0, 40.0, (-50.0, 50.0))
BOUNDS = {"M1": np.array([[-50.0, -30.0, 0.0], [50.0, 30.0, 40.0]])}
FOOT = frozenset({"G", "M1.L"})


@pytest.mark.parametrize(("times", "share"), [(0, 0.25), (1, 0.5), (2, 1.0), (3, 1.0)])
def test_each_time_a_pair_is_listed_its_hinge_has_twice_as_much(times, share):
    found = cut([BOX], TABLE, BOUNDS, PatchSettings(held=(FOOT,) * times))
    assert found.outlines["M1.L"].area == pytest.approx(100 * 10 + 100 * share * 30, rel=0.01)
    assert found.outlines["M1.R"].area == pytest.approx(100 * 10 + 25 * 30, rel=0.01)
    more = [note for note in found.notes if "for no flap fits on less" in note]
    assert more == (
        [f"G and M1.L: strips of the face reach for their hinge, {share:.0%} of it, for no flap fits on less"]
        if times
        else []
    )

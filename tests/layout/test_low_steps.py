"""Steps about a millimetre high: their walls are strips, and flaps on them are crumbs."""

from itertools import pairwise

import pytest

from popsim.design import Card, Design
from popsim.layout import NoFlapError, lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold, Top

CARD = Card(x=(-60, 60), depth=90)


def stepped(heights: tuple[float, float, float], ends: tuple[float, float, float, float]) -> Design:
    tops = tuple(Top(*span, height) for span, height in zip(pairwise(ends), heights, strict=True))
    return assemble(CARD, [BoxFold.stepped("M1", card_pair(CARD), 20, tops)])


@pytest.mark.parametrize("ends", [(-20, -4, -3, 15), (-30, 0, 1, 30)])
def test_a_net_is_opened_beside_a_flap_that_finds_no_room(ends: tuple[float, float, float, float]) -> None:
    """Nothing lies right beyond the short edge, but what lies beside it leaves no width for a flap."""
    layout = lay_out(stepped((20.5, 21.5, 25.6), ends))
    glued = {flap.joint.id for flap in layout.flaps}
    folded = {fold.joint.id for piece in layout.pieces for fold in piece.folds}
    assert glued | folded == {joint.id for joint in layout.joints}
    shortest = min(layout.flaps, key=lambda flap: flap.joint.length)
    assert shortest.joint.length == pytest.approx(1.0)
    assert shortest.polygon.area >= 1.0


def test_what_no_flap_can_hold_is_refused_with_its_length() -> None:
    with pytest.raises(
        NoFlapError, match=r"no flap fits between .* on its 0\.4 mm; make the hinge longer"
    ) as error:
        lay_out(stepped((20.5, 20.9, 21.3), (-20, -4, 0.1, 15)))
    assert "\n" not in str(error.value)
    assert error.value.between == " and ".join(sorted(error.value.patches))
    assert len(error.value.patches) == 2

"""Hinges are clipped to what the outlines leave of them, and recognised as one line again."""

import numpy as np
import pytest

from popsim.design import Card, Patch
from popsim.errors import DesignError
from popsim.mechanisms import MECHANISMS, Members, Shape, assemble, card_pair
from popsim.mechanisms.attach import held_stretches, lie_apart
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mechanisms.tent_fold import TentFold
from popsim.validity import examine

CARD = Card(x=(-150, 150), depth=200)
LINE = np.array([[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]])


def floor(*points, holes=(), name="A"):
    """A patch in the plane z = 0, given by (x, y)."""
    return Patch(
        id=name,
        outline=tuple((x, y, 0.0) for x, y in points),
        holes=tuple(tuple((x, y, 0.0) for x, y in hole) for hole in holes),
    )


def wall(*points, name="B"):
    """A patch in the plane y = 0, given by (x, z)."""
    return Patch(id=name, outline=tuple((x, 0.0, z) for x, z in points))


FLOOR = floor((0, 0), (40, 0), (40, 30), (0, 30))
WALL = wall((0, 0), (40, 0), (40, 20), (0, 20))
WHEELS = wall(
    (0, 5), (5, 5), (5, 0), (12, 0), (12, 5), (28, 5), (28, 0), (35, 0), (35, 5), (40, 5), (40, 20), (0, 20)
)


def spans(stretches):
    return [tuple(np.round(ends[:, 0], 6)) for ends in stretches]


def test_plain_faces_hold_along_the_whole_axis():
    stretches = held_stretches(LINE, FLOOR, WALL)
    assert spans(stretches) == [(0, 40)]
    assert np.array_equal(stretches[0], LINE)


def test_gaps_split_the_axis():
    assert spans(held_stretches(LINE, FLOOR, WHEELS)) == [(5, 12), (28, 35)]


def test_stretches_below_two_millimetres_are_dropped():
    narrow = wall((0, 0), (1.9, 0), (1.9, 5), (30, 5), (30, 0), (40, 0), (40, 20), (0, 20))
    assert spans(held_stretches(LINE, FLOOR, narrow)) == [(30, 40)]


def test_a_short_axis_may_be_shorter_than_two_millimetres():
    short = np.array([[0.0, 0.0, 0.0], [1.5, 0.0, 0.0]])
    tiny = wall((0, 0), (1.5, 0), (1.5, 3), (0, 3))
    assert spans(held_stretches(short, FLOOR, tiny)) == [(0, 1.5)]


def test_outlines_that_go_on_together_are_held_beyond_the_axis():
    longer = floor((-10, 0), (60, 0), (60, 30), (-10, 30))
    assert spans(held_stretches(LINE, longer, wall((0, 0), (55, 0), (55, 20), (0, 20)))) == [(0, 55)]


def test_a_hole_at_the_line_is_a_gap():
    across = floor((0, -10), (40, -10), (40, 30), (0, 30), holes=[[(10, -2), (20, -2), (20, 2), (10, 2)]])
    assert spans(held_stretches(LINE, across, WALL)) == [(0, 10), (20, 40)]


def test_outlines_beside_the_line_hold_nothing():
    assert held_stretches(LINE, FLOOR, wall((0, 0.1), (40, 0.1), (40, 20), (0, 20))) == []


def test_patches_that_would_overlap_when_unfolded_are_not_one_piece():
    risen = wall((0, -10), (40, -10), (40, 20), (0, 20))
    assert lie_apart(LINE, FLOOR, WALL)
    assert not lie_apart(LINE, FLOOR, risen)


@pytest.fixture
def box():
    return BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-60, -20, 30), Top(-20, 40, 50)))


def side(box, y, gap):
    """A side with a gap in its foot."""
    ring = np.array(box.profile(y))
    low, high = gap
    foot = np.array([[low, y, 0], [low, y, 8], [high, y, 8], [high, y, 0]], float)
    return Shape(np.concatenate([ring[:1], foot, ring[1:]]))


def test_wheel_gaps_give_lettered_hinges_and_the_box_is_recognised(box):
    shapes = {"M1.L": side(box, 30, (-30, 10)), "M1.R": side(box, -30, (-30, 10))}
    design = assemble(CARD, [box], shapes)
    feet = [hinge for hinge in design.hinges if hinge.patches == ("G", "M1.L")]
    assert [hinge.id for hinge in feet] == ["h1a", "h1b"]
    assert [tuple(hinge.points[:, 0]) for hinge in feet] == [(-60, -30), (10, 40)]
    assert examine(design).holds
    found = MECHANISMS["box-fold"].recognise(Members(design, design.mechanisms[0]))
    assert found.mechanism is not None
    assert found.mechanism.parameters() == box.parameters()


def test_plain_designs_are_the_same_with_their_own_faces_as_shapes(box):
    shapes = {box.patch_id(plate.role): Shape(plate.outline) for plate in box.plates()}
    plain, shaped = assemble(CARD, [box]), assemble(CARD, [box], shapes)
    assert [(h.id, h.axis, h.kind, h.crease) for h in shaped.hinges] == [
        (h.id, h.axis, h.kind, h.crease) for h in plain.hinges
    ]


def test_a_parapet_turns_the_fold_at_the_top_into_a_glue_joint(box):
    ring = np.array(box.profile(30))
    higher = ring + np.where(ring[:, 2:] == 50, 10.0, 0.0) * np.array([0, 0, 1])
    design = assemble(CARD, [box], {"M1.L": Shape(higher)})
    kinds = {h.patches: h.kind for h in design.hinges}
    assert kinds["M1.L", "M1.T_G2"] == "glue"
    assert kinds["M1.R", "M1.T_B2"] == "fold"


def test_a_gable_folds_up_to_its_peak(box):
    def gable(y):
        return Shape(np.array([[40, y, 0], [40, 0, 0], [40, 0, 70], [40, y, 50]], float))

    design = assemble(CARD, [box], {"M1.F_L": gable(30), "M1.F_R": gable(-30)})
    fold = next(h for h in design.hinges if set(h.patches) == {"M1.F_L", "M1.F_R"})
    assert sorted(fold.points[:, 2]) == [0, 70]


def test_tops_whose_ridges_leave_a_gap_meet_at_the_pair_between_them(box):
    def short(y):
        return Shape(np.array([[-15, 0, 50], [40, 0, 50], [40, y, 50], [-15, y, 50]], float))

    design = assemble(CARD, [box], {"M1.T_G2": short(30), "M1.T_B2": short(-30)})
    found = examine(design)
    assert found.holds
    assert found.mechanisms["M1"].parameters() == box.parameters()


def test_outlines_that_leave_nothing_of_a_hinge_are_refused():
    tent = TentFold("M1", card_pair(CARD), (-20, 20), 20, 30)
    plate = tent.plates()[0]
    lifted = plate.outline + np.where(plate.outline[:, 2:] == 0, [[0, -2, 3]], 0)
    with pytest.raises(DesignError, match=r"h1.*G and M1\.T_3 do not meet"):
        assemble(CARD, [tent], {"M1.T_3": Shape(lifted)})

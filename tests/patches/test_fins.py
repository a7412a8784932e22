"""Backbones rise as fins through slits in the tops, and the whole still folds."""

from functools import cache

import numpy as np
import pytest
from patch_solids import box_of, coloured_box, joined
from shapely.geometry import LineString, Point, Polygon

from popsim.design import Card
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair, plates_together
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mechanisms.tent_fold import TentFold
from popsim.patches import PatchSettings, paint
from popsim.patches.slits import PLAY, WIDTH
from popsim.pipeline.review import bare_sides
from popsim.verification import verify

CARD = Card(x=(-200, 200), depth=250)
BOX = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-50, 50, 40),))
BODY = coloured_box((-50, -30, 0), (50, 30, 40))
MAST = coloured_box((-10, -3, 40), (10, 3, 75))


@cache
def painted(*parts):
    surface = joined(BODY, *parts)
    return paint([BOX], surface, {"M1": box_of(surface)}, PatchSettings(dpi=75))


def test_a_mast_over_the_fold_becomes_a_fin_of_its_shape():
    fin = painted(MAST).shapes["M1.C"].outline
    above = fin[fin[:, 2] > 41]
    assert above[:, 2].max() == pytest.approx(75, abs=0.3)
    assert np.sort(above[:, 0])[[0, -1]] == pytest.approx([-10, 10], abs=0.3)


def test_its_top_has_a_slit_just_wide_enough():
    shapes = painted(MAST).shapes
    ground, backdrop = (Polygon(shapes[name].outline[:, :2]) for name in ("M1.T_G", "M1.T_B"))
    for x in (-10.2, 0.0, 10.2):
        assert not ground.contains(Point(x, 0.95 * WIDTH)) and ground.contains(Point(x, 1.05 * WIDTH))
        assert backdrop.contains(Point(x, -0.05))
    assert ground.contains(Point(-12, 0.05)) and ground.contains(Point(12, 0.05))


def test_it_is_printed_and_the_hidden_backbone_is_not():
    made = painted(MAST)
    frame = made.shapes["M1.C"].texture_frame
    assert frame is not None and frame.origin[2] > 35
    assert painted().shapes["M1.C"].texture is None


def test_fins_are_told_because_one_of_their_sides_stays_bare():
    assert painted(MAST).fins == ("M1.C",)
    assert painted().fins == ()
    (told,) = bare_sides(("M1.C",), None)
    assert "M1.C" in told and "both sides" in told and "white" in told
    assert "#202020" in bare_sides(("M1.C",), "#202020")[0]


def test_its_slit_is_cut_and_the_crease_stops_at_it():
    layout = lay_out(assemble(CARD, [BOX], painted(MAST).shapes), paper="700x900mm")
    piece = layout.piece_of["M1.T_G"]
    assert "M1.T_B" in piece.motions
    (slit,) = (Polygon(ring) for ring in piece.outline.interiors)
    sides = sorted(np.ptp(np.array(slit.exterior.coords), axis=0))
    assert sides[0] == pytest.approx(WIDTH, abs=0.05)
    assert sides[1] == pytest.approx(20 + 2 * PLAY, abs=0.5)
    creases = [LineString(fold.ends) for fold in piece.folds if {"M1.T_G", "M1.T_B"} == set(fold.joint.parts)]
    assert len(creases) == 2
    assert all(crease.distance(slit) < 0.1 and crease.intersection(slit).length < 0.1 for crease in creases)


def test_it_folds_with_all_its_hinges():
    verdict = verify(assemble(CARD, [BOX], painted(MAST).shapes))
    assert verdict.passed and verdict.grade == "rigid"


def test_what_hardly_rises_over_the_hinge_is_no_fin():
    kerb = coloured_box((-40, -3, 40), (40, 3, 43))
    fin = painted(kerb, MAST).shapes["M1.C"].outline
    assert np.sort(fin[fin[:, 2] > 41][:, 0])[[0, -1]] == pytest.approx([-10, 10], abs=0.3)


def test_a_ladder_that_leans_out_from_its_stand_stays_whole():
    """Both of its rails together are less than what a fin must rise by; they lie high enough nevertheless."""
    stand = coloured_box((26, -3, 40), (36, 3, 58))
    rails = [coloured_box((-40, -3, low), (26, 3, low + 1.6)) for low in (46.0, 56.4)]
    fin = painted(stand, *rails).shapes["M1.C"].outline
    above = fin[fin[:, 2] > 41]
    assert np.sort(above[:, 0])[[0, -1]] == pytest.approx([-40, 36], abs=0.3)
    assert above[above[:, 0] < 20, 2].min() > 44


def test_a_long_fin_stands_on_a_neck_and_leaves_the_rest_of_its_hinge():
    ridge = coloured_box((-50, -3, 40), (50, 3, 65))
    shapes = painted(ridge).shapes
    fin = Polygon(shapes["M1.C"].outline[:, [0, 2]])
    low, high = (fin.intersection(LineString([(-60, z), (60, z)])).length for z in (41, 55))
    assert high == pytest.approx(90, abs=1) and 6 <= low < high - 10
    verdict = verify(assemble(CARD, [BOX], shapes))
    assert verdict.passed and verdict.grade == "rigid"


def test_no_fin_takes_the_hinge_it_rises_from():
    short = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-6, 6, 40),))
    surface = joined(coloured_box((-6, -30, 0), (6, 30, 40)), coloured_box((-6, -3, 40), (6, 3, 75)))
    shapes = paint([short], surface, {"M1": box_of(surface)}, PatchSettings(dpi=75)).shapes
    assert shapes["M1.C"].outline[:, 2].max() == pytest.approx(40, abs=1e-6)
    assert verify(assemble(CARD, [short], shapes)).passed


def test_what_stands_beside_the_fold_is_no_fin():
    beside = coloured_box((-10, 12, 40), (10, 20, 75))
    assert painted(beside).shapes["M1.C"].outline[:, 2].max() == pytest.approx(40, abs=1e-6)


def test_a_pole_beside_the_fold_rises_from_the_front():
    pole = coloured_box((46, 12, 40), (50, 18, 110))
    front = painted(pole).shapes["M1.F_L"].outline
    assert front[:, 2].max() == pytest.approx(110, abs=0.3)
    assert np.sort(front[front[:, 2] > 41][:, 1])[[0, -1]] == pytest.approx([12, 18], abs=0.3)


def test_nothing_along_the_fold_rises_where_something_stands_on_the_top():
    top = next(pair for pair in BOX.pairs() if pair.patches == ("M1.T_G", "M1.T_B"))
    tent = TentFold("M2", top, (-20.0, 20.0), 15.0, 20.0)
    for plate in plates_together([BOX, tent])["M1"]:
        if plate.role in ("L", "R", "C"):
            above = plate.left[plate.left[:, 2] > 41]
            assert not ((above[:, 0] > -19) & (above[:, 0] < 19)).any()


def test_fins_stay_below_the_path_of_the_pairs_behind_their_top():
    stepped = BoxFold.stepped("M1", card_pair(CARD), 30, (Top(-50, 0, 60), Top(0, 80, 40)))
    room = plates_together([stepped])["M1"][2].room
    over = room[(room[:, 0] > 1) & (room[:, 0] < 29)]
    assert (over[:, 2] - 40 <= over[:, 0] + 1e-9).all()

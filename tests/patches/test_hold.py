"""Hinges get paper on both sides, as little as holds; patches do not reach through each other."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely.geometry import LineString, Point, Polygon, box

from popsim.geometry.plane import Plane
from popsim.mechanisms import Plate
from popsim.patches import PatchSettings
from popsim.patches.bridge import WIDTH
from popsim.patches.clean import cuttable, polygons, union, without
from popsim.patches.crossing import Meeting, uncross
from popsim.patches.hold import Run, hold
from popsim.patches.one_piece import NEAR, finished, reach
from popsim.patches.piece import Piece
from popsim.patches.slits import slit

SETTINGS = PatchSettings()
LINE = np.array([[0.0, 0.0, 0.0], [100.0, 0.0, 0.0]])
SPACE = np.array([[-1e3] * 3, [1e3] * 3])


def piece(shape, face=(0, 0, 100, 50), room=(-20, -20, 120, 90), principal=True, name="P"):
    """A piece in the plane y = 0, flat coordinates (x, z), that has a shape already."""
    plane = Plane(np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]))
    outline = plane.lift(np.array(box(*face).exterior.coords)[:-1])
    plate = Plate(name, outline, plane.normal, principal=principal)
    return Piece(name, plate, plane, box(*face), box(*room), SPACE, shape, Polygon())


def on_line(shape, z=0.0):
    """Stretches of the line at height z that a shape covers."""
    found = shape.buffer(1e-4).intersection(LineString([(-50, z), (150, z)]))
    parts = getattr(found, "geoms", [found])
    return [(round(p.bounds[0], 2), round(p.bounds[2], 2)) for p in parts if p.length > 0.01]


def test_a_silhouette_that_reaches_the_line_is_left_as_it_is():
    own = piece(box(0, 0, 100, 40))
    assert not hold([Run.of(own, LINE)], SETTINGS)
    assert own.shape.area == pytest.approx(4000, abs=1e-3)


def test_an_edge_within_snap_goes_to_the_line_and_a_gap_stays():
    own = piece(union(box(0, 1.2, 40, 40), box(60, 0.8, 100, 40), box(0, 20, 100, 40)))
    assert not hold([Run.of(own, LINE)], SETTINGS)
    assert on_line(own.shape) == [(0, 40), (60, 100)]


def wheels():
    """A truck side: two wheels of radius 12 below a body."""
    from shapely.geometry import Point

    return union(Point(20, 12).buffer(12), Point(80, 12).buffer(12), box(0, 10, 100, 40))


def test_wheels_are_joined_with_as_little_paper_as_holds():
    own = piece(wheels())
    before = own.shape.area
    assert hold([Run.of(own, LINE)], SETTINGS)
    stretches = on_line(own.shape)
    assert len(stretches) == 2
    assert sum(b - a for a, b in stretches) == pytest.approx(25, abs=2.5)
    assert own.shape.area - before < 40
    for (a, b), middle in zip(stretches, (20, 80), strict=True):
        assert (a + b) / 2 == pytest.approx(middle, abs=1.5)


def test_both_sides_of_a_joint_agree_on_where_it_holds():
    left, right = piece(box(0, 0, 30, 40)), piece(box(25, 0, 100, 40))
    hold([Run.of(left, LINE), Run.of(right, LINE)], SETTINGS)
    both = left.shape.intersection(right.shape)
    assert sum(b - a for a, b in on_line(both)) >= 24.9


def test_paper_is_added_where_nothing_shows():
    own = piece(Polygon())
    assert hold([Run.of(own, LINE)], SETTINGS)
    assert not own.shape.is_empty
    assert sum(b - a for a, b in on_line(own.shape)) >= 24.9


def test_a_base_patch_gets_paper_around_a_foot_inside_it():
    base = piece(box(0, 30, 100, 50))
    foot = LINE + np.array([0, 0, 15])
    run = Run.of(base, foot)
    assert run.inward is None
    hold([run], SETTINGS)
    assert sum(b - a for a, b in on_line(base.shape, 15.0)) >= 24.9


def mast_on_a_low_hull():
    """A patch inside whose upper hinge is held by nothing but a mast that goes on beyond it."""
    return piece(union(box(0, 15, 100, 40), box(40, -30, 60, 15)), room=(-20, -40, 120, 50), principal=False)


def test_a_hinge_is_held_beside_the_fin_that_passes_it():
    inside, top = mast_on_a_low_hull(), piece(box(0, 0, 100, 40), name="T")
    assert hold([Run.of(inside, LINE), Run.of(top, LINE)], SETTINGS)
    stretches = on_line(inside.shape.difference(box(38.5, -50, 61.5, 50)))
    assert sum(b - a for a, b in stretches) >= 24
    assert all(b <= 39 or a >= 61 for a, b in on_line(union(*inside.held)))


def test_a_fin_as_long_as_its_hinge_holds_it_with_what_there_is():
    inside = piece(box(0, -30, 100, 40), room=(-20, -40, 120, 50), principal=False)
    assert not hold([Run.of(inside, LINE), Run.of(piece(box(0, 0, 100, 40), name="T"), LINE)], SETTINGS)
    assert on_line(inside.shape) == [(0, 100)]


def test_without_a_patch_that_is_slit_the_mast_itself_holds():
    inside = mast_on_a_low_hull()
    hold([Run.of(inside, LINE)], SETTINGS)
    assert any(a <= 40 and b >= 60 for a, b in on_line(inside.shape))


def test_two_overhangs_at_one_hinge_do_not_cross():
    first = piece(union(box(0, 0, 100, 40), box(20, -10, 60, 0)), name="A")
    second = piece(union(box(0, 0, 100, 40), box(40, -5, 50, 0)), name="B")
    uncross([Meeting(LINE, [first, second])])
    assert first.shape.bounds[1] == -10
    assert second.shape.bounds[1] == 0


def test_overhangs_side_by_side_are_left():
    first = piece(union(box(0, 0, 100, 40), box(0, -10, 40, 0)), name="A")
    second = piece(union(box(0, 0, 100, 40), box(60, -5, 100, 0)), name="B")
    uncross([Meeting(LINE, [first, second])])
    assert (first.shape.bounds[1], second.shape.bounds[1]) == (-10, -5)


def test_overhangs_on_one_line_do_not_cross_without_a_hinge_between_them():
    first = piece(union(box(0, 0, 100, 40), box(20, -10, 60, 0)), name="A")
    second = piece(union(box(0, 0, 100, 40), box(40, -5, 50, 0)), name="B")
    uncross([Meeting(LINE, [first]), Meeting(LINE[::-1] * 0.5, [second])])
    assert (first.shape.bounds[1], second.shape.bounds[1]) == (-10, 0)


def test_hinge_edges_are_straight_and_exact_after_simplification():
    ragged = Polygon([(0, 0.3), (20, 0.9), (40, 0.1), (70, 1.1), (100, 0.2), (100, 40), (0, 40)])
    own = piece(ragged)
    hold([Run.of(own, LINE)], SETTINGS)
    outline, notes = finished(own, SETTINGS)
    assert notes == []
    assert on_line(outline) == [(0, 100)]
    assert outline.bounds[1] == 0
    assert len(outline.exterior.coords) <= 6


def test_near_islands_are_joined_and_far_ones_dropped_with_a_note():
    near = piece(union(box(0, 0, 60, 40), box(63, 10, 90, 40)))
    outline, notes = finished(near, SETTINGS)
    assert outline.contains(box(64, 11, 89, 39)) and notes == []
    far = piece(union(box(0, 0, 40, 40), box(80, 10, 90, 20)))
    outline, notes = finished(far, SETTINGS)
    assert outline.bounds[2] == 40
    assert notes == ["P: an island of 100 mm² is left out"]


@given(side=st.floats(4.5, 30), gap=st.floats(0.5, 50))
@example(side=5.0, gap=4.0)
@settings(max_examples=30, deadline=None)
def test_an_island_is_joined_over_what_its_size_is_worth(side, gap):
    island = box(40 + gap, 5, 40 + gap + side, 5 + side)
    own = piece(union(box(0, 0, 40, 40), island), room=(-20, -20, 200, 90))
    outline, notes = finished(own, SETTINGS)
    assert outline.intersection(island).area == pytest.approx(island.area if gap <= reach(island) else 0, abs=0.1)
    assert bool(notes) == (gap > NEAR)
    paper = outline.area - 1600 - outline.intersection(island).area
    assert -0.1 <= paper <= WIDTH * reach(island) + 0.1


def test_a_bridge_that_must_go_a_long_way_round_is_not_built():
    """A slot of 8 mm lies between, and leaves no room for paper but at its far end."""
    own = piece(union(box(0, 0, 16, 90), box(24, 60, 36, 90)), face=(0, 0, 16, 90))
    own.room = without(box(0, 0, 40, 90), box(16, 20, 24, 90))
    outline, notes = finished(own, SETTINGS)
    assert outline.bounds[2] == 16 and notes == ["P: an island of 360 mm² is left out"]
    own.room = box(0, 0, 40, 90)
    outline, notes = finished(own, SETTINGS)
    assert outline.bounds[2] == 36 and notes == ["P: an island of 360 mm² is joined over 8 mm"]


def test_islands_lead_to_others():
    middle, far = box(46, 0, 58, 12), box(66, 0, 80, 14)
    own = piece(union(box(0, 0, 40, 40), middle, far))
    outline, notes = finished(own, SETTINGS)
    assert outline.contains(far.buffer(-0.1)) and outline.contains(middle.buffer(-0.1))
    assert notes == [
        "P: an island of 144 mm² is joined over 6 mm",
        "P: an island of 196 mm² is joined over 8 mm",
    ]


def test_an_island_that_carries_a_hinge_is_always_joined():
    own = piece(union(box(0, 20, 40, 50), box(60, 0, 100, 10)))
    own.held.append(box(60, 0, 100, 2))
    outline, _ = finished(own, SETTINGS)
    assert outline.contains(box(61, 1, 99, 9)) and outline.contains(box(1, 21, 39, 49))


def test_a_bridge_that_would_leave_the_room_starts_from_the_face():
    face, mast = union(box(0, 0, 100, 20), box(70, 20, 80, 60)), box(42, 15, 48, 60)
    own = piece(union(box(0, 0, 100, 15), mast, box(70, 52, 80, 60)))
    own.face, own.room = face, union(face, box(40, 20, 50, 60))
    own.held.append(box(70, 57, 80, 60))
    before = own.shape.area
    outline, _ = finished(own, SETTINGS)
    assert outline.buffer(0.1).contains(own.shape)
    assert outline.area - before == pytest.approx(3 * 40, abs=10)


def test_a_fin_that_is_cut_takes_no_other_hinge_along():
    arch = union(box(0, 0, 30, 40), box(70, 0, 100, 40), box(0, 40, 100, 60))
    inside = piece(arch, face=(0, 0, 100, 40), room=(0, 0, 100, 70), principal=False, name="C")
    inside.held += [box(5, 0, 25, 2), box(75, 0, 95, 2), box(0, 38, 30, 40)]
    host = piece(box(0, 30, 100, 40), face=(0, 30, 100, 40), name="T")
    top = LINE + np.array([0.0, 0.0, 40.0])
    outlines = {"C": arch, "T": host.shape}
    slit(Run.of(inside, top), Run.of(host, top), [], outlines, SETTINGS)
    assert outlines["C"].geom_type == outlines["T"].geom_type == "Polygon"
    assert all(outlines["C"].buffer(0.01).contains(strip) for strip in inside.held)


@pytest.mark.parametrize("mated", [False, True])
def test_no_fin_takes_the_crease_of_what_it_passes(mated):
    top = LINE + np.array([0.0, 0.0, 40.0])
    body = box(0, 0, 100, 40)
    inside = piece(union(body, box(10, 40, 30, 70)), face=(0, 0, 100, 40), principal=False, name="C")
    host, mate = (
        piece(shape, face=(0, 30, 100, 40), name=name)
        for name, shape in (("T", box(0, 30, 100, 40)), ("U", box(8, 30, 34, 40)))
    )
    outlines = {each.id: each.shape for each in (inside, host, mate)}
    mates = [Run.of(mate, top)] if mated else []
    slit(Run.of(inside, top), Run.of(host, top), mates, outlines, SETTINGS)
    left = outlines["T"].intersection(outlines["U"]).intersection(box(0, 39.5, 100, 39.9)).area / 0.4
    assert (outlines["C"].bounds[3] == 70) == (not mated)
    assert left == pytest.approx(26 if mated else 5, abs=1)


def test_a_crease_is_held_beside_a_fin_that_rises_through_it():
    top = LINE + np.array([0.0, 0.0, 40.0])
    inside = piece(union(box(0, 0, 100, 40), box(10, 40, 60, 70)), face=(0, 0, 100, 40), principal=False, name="C")
    tops = [piece(box(0, 10, 100, 30), face=(0, 10, 100, 40), name=name) for name in ("T", "U")]
    crease, stand = Meeting(top, tops), Meeting(top, [tops[0], inside])
    assert [run.piece.id for run in crease.mates([crease, stand])] == ["C"]
    assert [run.piece.id for run in stand.mates([crease, stand])] == ["U"]
    hold(crease.runs(), SETTINGS, mates=crease.mates([crease, stand]))
    for own in tops:
        assert not own.shape.intersects(box(12, 39, 58, 40)) and own.shape.intersects(box(61, 39, 90, 40))


def test_nothing_at_all_gives_the_plain_face_with_a_note():
    own = piece(Polygon())
    outline, notes = finished(own, SETTINGS)
    assert outline.equals(own.face)
    assert "plain face" in notes[0]


def test_patches_inside_have_only_holes_that_are_seen_through():
    small, large = (box(0, 0, 100, 50).difference(box(20, 20, 20 + side, 20 + side)) for side in (2.5, 5))
    assert [len(finished(piece(each), SETTINGS)[0].interiors) for each in (small, large)] == [1, 1]
    inside = [finished(piece(each, principal=False), SETTINGS)[0] for each in (small, large)]
    assert [len(outline.interiors) for outline in inside] == [0, 1]


def test_no_sliver_is_left_of_a_ragged_outline():
    rng = np.random.default_rng(3)
    top = [(float(x), float(30 + rng.uniform(-3, 3))) for x in np.linspace(100, 0, 40)]
    own = piece(Polygon([(0, 0), (100, 0), *top]))
    outline, _ = finished(own, SETTINGS)
    assert len(polygons(outline)) == 1
    assert outline.is_valid


def test_masts_too_thin_to_cut_are_made_wider_and_thin_specks_go():
    deck, mast, speck = box(0, 0, 100, 20), box(50, 19, 51, 60), box(20, 19, 21, 22)
    made = cuttable(union(deck, mast, speck), box(0, 0, 100, 70), SETTINGS)
    across = made.intersection(LineString([(40, 40), (60, 40)])).length
    assert SETTINGS.thinnest <= across < 1.5 * SETTINGS.thinnest
    assert made.bounds[3] == pytest.approx(60, abs=1.0)
    assert not made.contains(Point(20.5, 21.5))

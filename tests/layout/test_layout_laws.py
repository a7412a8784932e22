"""Laws that every layout keeps, over random nested designs."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest
import shapely
from shapely.geometry import box as rectangle

from popsim.geometry.flat import move_shape
from popsim.layout import Crease, Layout, LayoutSettings, draw_sheets, lay_out
from popsim.layout.sheet import Line, Role, Text
from popsim.stock import parse_stock
from popsim.verification.random_designs import random_design

CASES = [
    *((seed, (1, 4), "A4", LayoutSettings()) for seed in range(6)),
    *((seed, (1, 4), "Letter", LayoutSettings(grain=True)) for seed in range(8, 11)),
    *((seed, (1, 3), "200x180mm", LayoutSettings(margin=5, seam_depth=8)) for seed in range(11, 14)),
    *((seed, (1, 4), "A4", LayoutSettings(stock=parse_stock("200gsm"), gap=4)) for seed in (14, 16, 21)),
    *((seed, (6, 9), "A3", LayoutSettings(flap_depth=8, bleed=2)) for seed in range(17, 19)),
    (19, (2, 4), "Letter", LayoutSettings(registration="silhouette")),
    (20, (2, 4), "A4", LayoutSettings(registration="cricut")),
]
"""Seed, least and greatest number of mechanisms, paper and settings; on the small sheets patches are divided."""

ROUNDING = 0.02
"""mm^2; areas of cut-offs by snapping to the grid."""

UNSEEN = 0.01
"""mm; creases end where hinges do, beyond outlines by less."""


@pytest.fixture(scope="module", params=CASES, ids=lambda case: f"{case[0]}-{case[2]}")
def layout(request: pytest.FixtureRequest) -> Layout:
    seed, mechanisms, paper, settings = request.param
    return lay_out(random_design(seed, mechanisms=mechanisms).design, paper=paper, settings=settings)


def test_every_part_is_in_one_piece(layout: Layout) -> None:
    assert Counter(part for piece in layout.pieces for part in piece.motions) == Counter(list(layout.parts))
    assert [placement.piece for placement in layout.placements] == list(layout.pieces)


def test_every_joint_is_a_fold_or_glued_once(layout: Layout) -> None:
    glued = Counter((flap.joint.id, flap.stretch) for flap in layout.flaps)
    flap_creases = {(flap.joint.id) for flap in layout.flaps}
    folded = {fold.joint.id for piece in layout.pieces for fold in piece.folds} - flap_creases
    assert set(glued.values()) == {1}
    assert folded | flap_creases == {joint.id for joint in layout.joints}
    assert set(layout.numbers) == flap_creases
    assert sorted(layout.numbers.values()) == list(range(1, len(flap_creases) + 1))


def test_a_crease_lies_on_the_hinge_in_both_parts(layout: Layout) -> None:
    for piece in layout.pieces:
        for fold in piece.folds:
            spots = shapely.points(fold.ends)
            for part in fold.joint.parts:
                if part in piece.motions and fold.joint.id not in layout.numbers:
                    shape = move_shape(piece.motions[part], layout.parts[part].polygon)
                    assert shapely.distance(spots, shape.boundary).max() < 0.06


def test_parts_and_flaps_of_a_piece_do_not_overlap(layout: Layout) -> None:
    for piece in layout.pieces:
        shapes = [move_shape(motion, layout.parts[name].polygon) for name, motion in piece.motions.items()]
        shapes += [move_shape(piece.motions[flap.carrier], flap.polygon) for flap in piece.flaps]
        for one, other in combinations(shapes, 2):
            assert one.intersection(other).area < ROUNDING
        assert piece.outline.area == pytest.approx(
            sum(shape.area for shape in shapes), abs=0.1 + 0.05 * len(shapes)
        )
        assert piece.outline.is_valid


def test_flaps_stay_inside_their_targets(layout: Layout) -> None:
    for flap in layout.flaps:
        assert flap.landing.difference(layout.parts[flap.target].polygon).area < ROUNDING
        assert flap.landing.area == pytest.approx(flap.polygon.area)


def test_flaps_on_one_face_do_not_overlap(layout: Layout) -> None:
    faces: dict[tuple[str, int], list[shapely.Polygon]] = {}
    for flap in layout.flaps:
        faces.setdefault((flap.target, flap.face.value), []).append(flap.landing)
    for landings in faces.values():
        for one, other in combinations(landings, 2):
            assert one.intersection(other).area < ROUNDING


def test_a_folded_flap_lies_where_it_lands(layout: Layout) -> None:
    for flap in layout.flaps:
        carrier, target = layout.parts[flap.carrier], layout.parts[flap.target]
        on_line = target.plane.lift(np.array(flap.landing.exterior.coords))
        hinge = flap.joint.stretches[flap.stretch]
        along = (hinge[1] - hinge[0]) / np.linalg.norm(hinge[1] - hinge[0])
        flat = carrier.plane.lift(np.array(flap.polygon.exterior.coords))
        for spots in (on_line, flat):  # turning about the hinge keeps both coordinates
            assert (spots - hinge[0]) @ along == pytest.approx((on_line - hinge[0]) @ along, abs=1e-6)
        far = [np.linalg.norm(np.cross(spots - hinge[0], along), axis=1) for spots in (on_line, flat)]
        assert far[0] == pytest.approx(far[1], abs=1e-6)


def test_pieces_keep_off_each_other_and_the_margins(layout: Layout) -> None:
    width, height = layout.settings.area(layout.paper)
    x, y = layout.settings.corner(layout.paper)
    area = rectangle(x, y, x + width, y + height).buffer(1e-6)
    sheets: dict[int, list[shapely.Polygon]] = {}
    for placement in layout.placements:
        sheets.setdefault(placement.sheet, []).append(move_shape(placement.motion, placement.piece.outline))
    assert sorted(sheets) == list(range(layout.sheet_count))
    for shapes in sheets.values():
        assert all(area.contains(shape) for shape in shapes)
        for one, other in combinations(shapes, 2):
            assert one.distance(other) >= layout.settings.gap - 1e-6


def test_each_number_stands_on_flap_and_place(layout: Layout) -> None:
    sheets = draw_sheets(layout)
    texts = Counter(mark.text.strip("()") for sheet in sheets for mark in sheet.marks if isinstance(mark, Text))
    flaps = Counter(layout.numbers[flap.joint.id] for flap in layout.flaps)
    for number, count in flaps.items():
        assert texts[str(number)] == 2 * count


def test_all_marks_lie_on_the_paper(layout: Layout) -> None:
    for sheet in draw_sheets(layout, footer="x" * 400, banner="NOT VERIFIED: " + "x" * 80):
        for mark in sheet.marks:
            if isinstance(mark, Line):
                assert mark.points.min() >= layout.settings.margin - UNSEEN
                beyond = mark.points - (sheet.width, sheet.height) + layout.settings.margin
                assert beyond.max() <= UNSEEN


def test_no_line_is_drawn_twice(layout: Layout) -> None:
    for sheet in draw_sheets(layout):
        lines = [mark for mark in sheet.of(Role.CUT, Role.MOUNTAIN, Role.VALLEY) if isinstance(mark, Line)]
        rings = [
            shapely.LineString([*line.points, line.points[0]] if line.closed else line.points) for line in lines
        ]
        total, once = sum(ring.length for ring in rings), shapely.unary_union(rings, grid_size=1e-3).length
        assert total == pytest.approx(once, abs=0.05 * len(rings))


def test_seams_have_no_crease(layout: Layout) -> None:
    for flap in layout.flaps:
        assert (flap.crease is Crease.NONE) == (flap.joint.hinge is None)

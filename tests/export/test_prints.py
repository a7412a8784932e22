"""Pictures on sheets: bled over the cut, blank under glue, white under creases."""

from itertools import chain

import pytest
import shapely
from printed_design import Printed
from shapely.geometry import LineString, Polygon

from popsim.geometry.flat import move_shape
from popsim.layout import Face, LayoutSettings, draw_sheets
from popsim.layout.piece_pictures import UNDERLAP
from popsim.layout.sheet import Line, Picture, Role, Sheet

BLEED = LayoutSettings().bleed


def area(picture: Picture) -> Polygon:
    """The clip of a picture, even-odd."""
    filled = Polygon()
    for ring in picture.clip:
        filled = filled.symmetric_difference(Polygon(ring))
    return filled


@pytest.fixture(scope="module")
def sheets(printed: Printed) -> tuple[Sheet, ...]:
    return draw_sheets(printed.layout)


def test_pictures_cover_their_parts_and_bleed(printed: Printed, sheets: tuple[Sheet, ...]) -> None:
    for placement in printed.layout.placements:
        for name, motion in placement.piece.motions.items():
            part = printed.layout.parts[name]
            if part.patch.texture is None:
                continue
            (picture,) = (
                mark
                for mark in sheets[placement.sheet].of(Role.PRINT)
                if isinstance(mark, Picture) and mark.image == part.patch.texture
            )
            shape = move_shape(placement.motion @ motion, part.polygon)
            landings = [
                move_shape(placement.motion @ motion, flap.landing)
                for flap in placement.piece.places
                if flap.target == name and flap.face is Face.PRINTED
            ]
            assert shape.difference(shapely.unary_union([area(picture), *landings])).area < 0.01
            assert area(picture).difference(shape.buffer(BLEED * 2)).area < 0.01
            others = [
                move_shape(placement.motion @ other, printed.layout.parts[key].polygon)
                for key, other in placement.piece.motions.items()
                if key != name
            ]
            rim = shape.buffer(0.9 * BLEED).difference(shapely.unary_union([shape, *others]))
            assert rim.difference(area(picture)).area < 0.01


def test_nothing_is_printed_under_glue(printed: Printed, sheets: tuple[Sheet, ...]) -> None:
    checked = 0
    for placement in printed.layout.placements:
        ink = [area(mark) for mark in sheets[placement.sheet].of(Role.PRINT) if isinstance(mark, Picture)]
        for flap in placement.piece.places:
            if flap.face is Face.PRINTED and printed.layout.parts[flap.target].patch.texture:
                motion = placement.motion @ placement.piece.motions[flap.target]
                glued = move_shape(motion, flap.landing).buffer(-UNDERLAP, join_style="mitre")
                assert max(shape.intersection(glued).area for shape in ink) < 1e-3
                checked += 1
    assert checked > 0


def test_creases_on_pictures_lie_on_white(sheets: tuple[Sheet, ...]) -> None:
    for sheet in sheets:
        pictures = shapely.unary_union([area(m) for m in sheet.of(Role.PRINT) if isinstance(m, Picture)])
        white = {m.points.tobytes() for m in sheet.of(Role.PRINT) if isinstance(m, Line)}
        for crease in chain(sheet.of(Role.MOUNTAIN), sheet.of(Role.VALLEY)):
            inside = LineString(crease.points).intersection(pictures.buffer(-1.5 * BLEED)).length
            assert crease.points.tobytes() in white or inside == 0

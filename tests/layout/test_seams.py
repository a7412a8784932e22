"""Where patches are divided depends on what else goes onto the sheets."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hand_made import shares
from shapely.geometry import box

from popsim.design import Card, Design
from popsim.geometry.flat import move_shape
from popsim.layout import Layout, LayoutSettings, find_paper, lay_out
from popsim.layout import seams as seams_module
from popsim.layout.divisions import count_parts, other_divisions, parts_of, plain_divisions
from popsim.layout.seams import lay_out_divided
from popsim.layout.sketch import Sketch
from popsim.layout.split import Flaps, Hints, cut
from popsim.layout.waste import WELL_FILLED, Waste
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold

SETTINGS = LayoutSettings()
ROOM = SETTINGS.area(find_paper("A4"))
NO_HINTS = Hints([], [])
FLAPS = Flaps(np.array([0.0, 10.0]), 20.0)


def design(length: float, depth: float, half_width: float = 40.0, height: float = 90.0) -> Design:
    card = Card(x=(-length / 2, length / 2), depth=depth)
    reach = length / 2 - half_width - 5
    return assemble(card, [BoxFold.plain("M1", card_pair(card), half_width, height, (-reach, reach))])


def seams(layout: Layout) -> int:
    return sum(joint.hinge is None for joint in layout.joints)


@pytest.mark.parametrize("leaning", [0.0, 0.25, 0.5, 1.0])
def test_a_seam_is_where_it_leans(leaning: float) -> None:
    first, second = cut(box(0, 0, 320, 160), ROOM, FLAPS, NO_HINTS, leaning=leaning)
    most = max(ROOM) - 20.0
    wanted = (320 - most) + leaning * (2 * most - 320)
    assert first.bounds[2] == second.bounds[0] == pytest.approx(wanted, abs=0.15 * (2 * most - 320))
    assert first.area + second.area == pytest.approx(320 * 160)


def test_one_part_more_can_be_made() -> None:
    assert len(cut(box(0, 0, 320, 160), ROOM, FLAPS, NO_HINTS, leaning=0.2, more=1)) == 3


def test_flaps_of_seams_take_room_only_where_there_are_seams() -> None:
    """As deep as the sheet but for its own flap, a page needs strips alone, no rows of them."""
    high = max(ROOM) - 11
    parts = cut(box(0, 0, 400, high), ROOM, FLAPS, NO_HINTS)
    assert len(parts) == 3
    assert {part.bounds[3] - part.bounds[1] for part in parts} == {high}


def test_without_grain_a_part_may_be_as_long_as_the_sheet_is() -> None:
    free, fixed = (cut(box(0, 0, 320, 160), ROOM, FLAPS, NO_HINTS, grain=grain) for grain in (False, True))
    assert max(part.bounds[2] - part.bounds[0] for part in free) > min(ROOM)
    assert max(part.bounds[2] - part.bounds[0] for part in fixed) <= min(ROOM) - 20


def test_all_divisions_cover_their_patches_and_are_different() -> None:
    made = design(320, 165)
    (plain,) = plain_divisions(made, ROOM, SETTINGS)
    others = other_divisions(plain, (), made, ROOM, SETTINGS)
    assert set(plain) == {"G", "B"}
    assert len({tuple(p.wkb for polygons in way.values() for p in polygons) for way in (plain, *others)}) > 4
    for way in (plain, *others):
        assert count_parts(way) <= count_parts(plain) + 2
        for polygons in way.values():
            assert shapely.unary_union(polygons).area == pytest.approx(320 * 165)
        # seams meet, so that flaps across the fold stay whole
        ends = [{round(float(p.bounds[k]), 3) for p in polygons for k in (0, 2)} for polygons in way.values()]
        assert ends[0] == ends[1]


def test_patches_divided_both_ways_can_have_a_row_of_parts_more() -> None:
    """Pages of two by two parts: three by two beside other ways of two by two, nothing more."""
    made = design(440, 270)
    plain = plain_divisions(made, ROOM, SETTINGS)[0]
    assert {name: len(polygons) for name, polygons in plain.items()} == {"G": 4, "B": 4}
    others = other_divisions(plain, (), made, ROOM, SETTINGS)
    assert {count_parts(way) for way in others} == {8, 12}
    for way in others:
        for polygons in way.values():
            assert shapely.unary_union(polygons).area == pytest.approx(440 * 270)


def test_a_sketch_is_near_to_what_is_planned() -> None:
    """Shapes drawn for the division that was planned are its pieces, but for small differences of flaps."""
    made = design(320, 165)
    layout = lay_out(made, paper="A4")
    divided = {"G": [], "B": []}
    for part in layout.parts.values():
        if part.patch.id in divided:
            divided[part.patch.id].append(part.polygon)
    from popsim.layout.laid import Planned
    from popsim.layout.nets import Net

    nets = tuple(
        Net(
            piece.motions,
            tuple(dict.fromkeys(f.joint for f in piece.folds if f.joint.id not in layout.numbers)),
        )
        for piece in layout.pieces
    )
    planned = Planned(layout.parts, layout.joints, nets, layout.flaps, layout.pieces)
    shapes = Sketch(planned, SETTINGS.seam_depth).shapes({name: tuple(own) for name, own in divided.items()})
    drawn, real = (sorted(shape.area for shape in group) for group in (shapes, planned.outlines))
    assert drawn == pytest.approx(real, rel=0.03)


@pytest.mark.parametrize("paper", ["A4", "Letter"])
@pytest.mark.parametrize("length", [300.0, 320.0, 360.0])
def test_sheets_are_well_filled_though_patches_are_divided(length: float, paper: str) -> None:
    layout = lay_out(design(length, length / 2), paper=paper)
    assert seams(layout) >= 2
    assert shares(layout)[:-1].min() >= WELL_FILLED


def test_seams_are_moved_only_where_that_is_worth_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of what is laid out with the plainest seams alone, no more sheets are used, and none is filled less well."""
    for length, half_width, height in ((320.0, 50.0, 110.0), (310.0, 40.0, 60.0)):
        made = design(length, length / 2, half_width, height)
        chosen = lay_out(made, paper="A4")
        with monkeypatch.context() as patch:
            patch.setattr("popsim.layout.layout.other_divisions", lambda *_: ())
            plain = lay_out(made, paper="A4")
        assert chosen.sheet_count <= plain.sheet_count
        if chosen.sheet_count == plain.sheet_count:
            assert min(shares(chosen)[:-1].min(), WELL_FILLED) >= min(shares(plain)[:-1].min(), WELL_FILLED)


@pytest.mark.parametrize(
    ("lacking", "content", "planned", "yielded"),
    [
        ({"best": 0.0}, False, ["plain", "best"], ["plain", "best"]),
        ({"best": 0.1, "next": 0.0}, False, ["plain", "best", "next"], ["plain", "best", "next"]),
        ({"best": 0.3, "next": 0.3, "last": 0.1}, False, ["plain", "best", "next", "last"], ["plain", "last"]),
        ({"best": 0.3, "next": 0.0}, True, ["plain", "best"], ["plain"]),
    ],
)
def test_what_seems_next_best_is_planned_too_while_sheets_are_not_well_filled(
    monkeypatch: pytest.MonkeyPatch,
    lacking: dict[str, float],
    content: bool,
    planned: list[str],
    yielded: list[str],
) -> None:
    """Estimates are not exact; but nothing more is planned once all sheets are filled, here or otherwise."""
    ways = {name: ({name: ()},) for name in ("plain", "best", "next", "last")}
    asked: list[str] = []

    def plan(divisions: tuple[dict[str, tuple[()]], ...]) -> SimpleNamespace:
        asked.append(next(iter(divisions[0])))
        return SimpleNamespace(name=asked[-1], shares=lambda room: [0.5] * 4)

    def place(made: SimpleNamespace) -> SimpleNamespace:
        short = lacking.get(made.name, 0.3)
        return SimpleNamespace(name=made.name, waste=lambda room: Waste(3, short, 0.5, -1.0, ()))

    monkeypatch.setattr(seams_module, "Sketch", lambda *_: None)
    monkeypatch.setattr(seams_module, "_sketched", lambda *_: [ways["best"], ways["next"], ways["last"]])
    found = lay_out_divided(plan, place, ways["plain"], list, None, ROOM, SETTINGS, lambda: content)
    assert [laid.name for laid in found] == yielded
    assert asked == planned


def test_parts_are_in_the_order_of_the_design() -> None:
    made = design(320, 165)
    names = [part.id for part in parts_of(made, plain_divisions(made, ROOM, SETTINGS))]
    assert names[:4] == ["G/1", "G/2", "B/1", "B/2"]
    assert set(names[4:]) == {patch.id for patch in made.patches[2:]}


def test_grain_divides_what_goes_on_turned_alone() -> None:
    """A page that is deeper than the sheet is wide is divided: its fold runs along the sheet, nothing turns."""
    made = design(120, 230, half_width=20, height=30)
    assert seams(lay_out(made, paper="A4")) == 0
    layout = lay_out(made, paper="A4", settings=LayoutSettings(grain=True))
    assert seams(layout) == 2
    for placement in layout.placements:
        assert abs(placement.motion[0, 1]) < 1e-9
        assert box(0, 0, 210, 297).contains(move_shape(placement.motion, placement.piece.outline))

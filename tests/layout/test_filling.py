"""Filling sheets: where a piece goes on a sheet, and which sheets it tries first."""

from random import Random

import numpy as np
import pytest
from shapely.geometry import Polygon, box

from popsim.geometry.flat import move_shape
from popsim.layout.filling import Filler
from popsim.layout.nesting import nest
from popsim.layout.orders import First, Order, first_orders
from popsim.layout.sheet_raster import Grid, SheetRaster, Turns
from popsim.layout.waste import taken_of, waste_of

ROOM = (100.0, 200.0)
GAP = 2.0


def filler(shapes: list[Polygon]) -> Filler:
    made = Filler(ROOM, GAP, 1.0)
    for shape in shapes:
        made.add(shape, [0.0])
    return made


def test_a_piece_goes_where_it_fits_most_snugly() -> None:
    """A bay as wide as the piece beats the floor that lies lower."""
    grid = Grid.over(ROOM, GAP, 1.0)
    walls = Polygon([(0, 60), (0, 100), (100, 100), (100, 60), (74, 60), (74, 90), (36, 90), (36, 60)])
    sheet = SheetRaster.empty(grid)
    low = Turns.of(walls, [0.0], GAP, grid)
    (row, column, _) = spot = sheet.fit(low, [0], sheet.spectrum(), low=False).spot or pytest.fail(
        "an empty sheet has room"
    )
    assert (row, column) == (0, 0)  # in a corner, as all others fit no better
    sheet = sheet.taking(spot, low)
    piece = box(0, 0, 30, 25)
    turns = Turns.of(piece, [0.0], GAP, grid)
    found = sheet.fit(turns, [0], sheet.spectrum(), low=False).spot
    assert found is not None
    moved = move_shape(turns.motion(found), piece)
    assert 36 + GAP < moved.bounds[0] < moved.bounds[2] < 74 - GAP
    assert moved.bounds[3] < 30  # up in the bay, whose roof is 30 over the foot of the walls


def test_the_last_sheet_is_filled_from_its_foot() -> None:
    """Snugly, two bars would lie along opposite ends; what stays free is wanted in one piece."""
    shapes = [box(0, 0, 60, 20), box(0, 0, 60, 20)]
    places = nest(shapes, ["a", "b"], ROOM, GAP, grain=False)
    tops = [move_shape(place.motion, shape).bounds[3] for place, shape in zip(places, shapes, strict=True)]
    assert max(tops) < 62


def test_a_full_sheet_has_no_place() -> None:
    grid = Grid.over(ROOM, GAP, 1.0)
    turns = Turns.of(box(0, 0, 90, 150), [0.0], GAP, grid)
    sheet = SheetRaster.empty(grid)
    spot = sheet.fit(turns, [0], sheet.spectrum(), low=False).spot
    assert spot is not None
    sheet = sheet.taking(spot, turns)
    assert not sheet.has_room(turns)
    assert sheet.fit(turns, [0], sheet.spectrum(), low=False) == (None, ())


def test_turns_that_cover_the_same_cells_are_one() -> None:
    grid = Grid.over(ROOM, GAP, 1.0)
    angles = [0.0, np.pi / 2, np.pi, 3 * np.pi / 2]
    assert len(Turns.of(box(0, 0, 40, 30), angles, GAP, grid).masks) == 2
    assert len(Turns.of(Polygon([(0, 0), (40, 0), (0, 30)]), angles, GAP, grid).masks) == 4


def test_sheets_in_need_are_tried_first() -> None:
    """The first three leave room for the small one; the second needs it, and the third needs it most."""
    shapes = [box(0, 0, 100, height) for height in (130, 105, 102, 98, 20)]
    own = filler(shapes)
    found = {first: own.filling(Order((0, 1, 2, 3, 4), first)) for first in First}
    assert {first: [place.sheet for place in one.places] for first, one in found.items()} == {
        First.OLDEST: [0, 1, 2, 3, 0],
        First.NEEDY: [0, 1, 2, 3, 1],
        First.NEEDIEST: [0, 1, 2, 3, 2],
    }
    assert found[First.OLDEST].waste.lacking == pytest.approx(0.025 + 0.04)
    assert found[First.NEEDIEST].waste.lacking == pytest.approx(0.025)


def test_orders_can_be_of_some_shapes_alone() -> None:
    """What an estimate asks about again and again is some of all shapes that are known."""
    shapes = [box(0, 0, 100, height) for height in (130, 105, 60)]
    alone = filler(shapes[1:]).filling(Order((0, 1), First.OLDEST))
    some = filler(shapes).filling(Order((1, 2), First.OLDEST))
    assert some.waste == alone.waste
    assert all((a.motion == b.motion).all() for a, b in zip(some.places, alone.places, strict=True))


def test_shares_of_sheets_are_summed() -> None:
    assert taken_of([0.5, 0.25, 0.125], [1, 0, 1]).tolist() == [0.25, 0.625]
    assert waste_of([], []).sheets == 0


def test_orders_hold_every_piece_once() -> None:
    shapes = [box(0, 0, k, 20 - k) for k in range(1, 15)]
    random = Random(3)
    orders = list(first_orders(dict(enumerate(shapes)), random))
    assert len(set(orders)) == len(orders)
    for _ in range(100):
        orders.append(orders[-1].changed(random))
    assert all(sorted(order.pieces) == list(range(len(shapes))) for order in orders)
    assert len(set(orders[-100:])) > 80


def test_a_sheet_is_filled_from_one_that_has_plenty() -> None:
    """Largest first, the first sheet takes all small pieces; one of them belongs to the second."""
    shapes = [box(0, 0, 100, 108), box(0, 0, 100, 106), box(0, 0, 100, 104), *[box(0, 0, 48, 20)] * 3]
    places = nest(shapes, [str(k) for k in range(len(shapes))], ROOM, GAP, grain=False)
    shares = [shape.area / (ROOM[0] * ROOM[1]) for shape in shapes]
    waste = waste_of(shares, [place.sheet for place in places])
    assert (waste.sheets, waste.lacking) == (3, 0.0)
    assert np.all(np.diff(taken_of(shares, [place.sheet for place in places])) <= 0)

"""Nesting alone: shapes in, places out."""

import numpy as np
import pytest
from shapely import affinity
from shapely.geometry import Polygon, box

from popsim.geometry.flat import move_shape
from popsim.layout import LayoutError
from popsim.layout.nesting import nest

ROOM = (190.0, 254.0)


def random_shapes(count: int) -> list[Polygon]:
    rng = np.random.default_rng(7)
    shapes = []
    for _ in range(count):
        angles = np.sort(rng.random(9)) * 2 * np.pi
        radii = 8 + 25 * rng.random(9)
        shapes.append(Polygon(np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)).buffer(0))
    return [shape for shape in shapes if shape.geom_type == "Polygon" and shape.is_valid]


def test_irregular_shapes_share_sheets() -> None:
    shapes, room = random_shapes(18), (120.0, 160.0)
    places = nest(shapes, [str(k) for k in range(len(shapes))], room, 3.0, grain=False)
    filled = np.zeros(max(place.sheet for place in places) + 1)
    for shape, place in zip(shapes, places, strict=True):
        filled[place.sheet] += shape.area / (room[0] * room[1])
    assert len(filled) > 1
    assert filled[:-1].min() > 0.5


def test_a_shape_of_exactly_the_room_fits() -> None:
    (place,) = nest([box(0, 0, 190, 254)], ["all"], ROOM, 3.0, grain=False)
    assert move_shape(place.motion, box(0, 0, 190, 254)).bounds == pytest.approx((0, 0, 190, 254))


def test_a_shape_beyond_the_room_is_named() -> None:
    with pytest.raises(LayoutError, match="piece big does not go onto the sheet"):
        nest([box(0, 0, 200, 300)], ["big"], ROOM, 3.0, grain=False)


def test_a_long_shape_goes_aslant() -> None:
    slanted = affinity.rotate(box(0, 0, 250, 20), 30)
    (place,) = nest([slanted], ["strip"], ROOM, 3.0, grain=False)
    assert move_shape(place.motion, slanted).bounds[2] <= 190


def test_grain_keeps_the_direction() -> None:
    shapes = [box(0, 0, 100, 30)] * 6
    for place in nest(shapes, list("abcdef"), ROOM, 3.0, grain=True):
        assert abs(place.motion[0, 1]) < 1e-9
    with pytest.raises(LayoutError):
        nest([box(0, 0, 240, 30)], ["wide"], ROOM, 3.0, grain=True)


def test_same_shapes_same_places() -> None:
    shapes = random_shapes(8)
    names = [str(k) for k in range(len(shapes))]
    one, other = (nest(shapes, names, ROOM, 3.0, grain=False) for _ in range(2))
    for a, b in zip(one, other, strict=True):
        assert a.sheet == b.sheet
        assert (a.motion == b.motion).all()

"""Borders of primitives as numbers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from popsim.fitting.knobs import knobs, simplified, thinnest, turned
from popsim.mechanisms import Primitive, PrismRow, RectangularPrism, TriangularPrism

PRIMITIVES: list[Primitive] = [
    PrismRow(20.0, 5.0, ((-30.0, -10.0, 12.0), (-10.0, 20.0, 40.0))),
    RectangularPrism((0.0, -30.0, 0.0), (10.0, -20.0, 15.0)),
    RectangularPrism((0.0, 20.0, 0.0), (10.0, 35.0, 15.0)),
    RectangularPrism((-10.0, -10.0, 0.0), (10.0, 10.0, 15.0), turned=True),
    TriangularPrism((0.0, -10.0, 5.0), (40.0, 10.0, 25.0), edges="x"),
    TriangularPrism((0.0, -10.0, 5.0), (10.0, 10.0, 25.0), edges="z", facing=-1),
]


@pytest.mark.parametrize("primitive", PRIMITIVES, ids=lambda p: type(p).__name__)
def test_knobs_where_they_are_give_the_primitive_back(primitive: Primitive) -> None:
    assert turned(primitive, [value for _, value in knobs(primitive)]) == primitive


@pytest.mark.parametrize("primitive", PRIMITIVES, ids=lambda p: type(p).__name__)
def test_the_highest_knob_along_z_raises_the_primitive(primitive: Primitive) -> None:
    values = [value + (3.0 if axis == 2 else 0.0) for axis, value in knobs(primitive)]
    raised = knobs(turned(primitive, values))
    assert max(v for a, v in raised if a == 2) == max(v for a, v in knobs(primitive) if a == 2) + 3.0


@given(st.lists(st.tuples(st.floats(0.5, 30), st.floats(1, 60)), min_size=1, max_size=8), st.floats(1, 10))
def test_simplified_row_has_nothing_thin(parts: list[tuple[float, float]], least: float) -> None:
    tops, at = [], 0.0
    for length, height in parts:
        tops.append((at, at + length, height))
        at += length
    row = PrismRow(50.0, 0.0, tuple(tops))
    found = simplified(row, least)
    assert isinstance(found, PrismRow)
    assert {height for _, _, height in found.tops} <= {height for _, height in parts}
    if len(found.tops) > 1:
        assert min(found.tops[0][2], found.tops[-1][2]) >= least
        raised = PrismRow(50.0, 0.0, tuple((a, b, height + least) for a, b, height in found.tops))
        assert thinnest(raised) >= least * (1 - 1e-9)

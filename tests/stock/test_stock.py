"""What paper is, as people name it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from popsim.errors import InputError
from popsim.stock import Stock, parse_stock, split_stock


def test_defaults_are_those_of_the_stated_formulas():
    stock = parse_stock("200gsm")
    assert stock.name == "200gsm"
    assert stock.thickness == pytest.approx(0.25)
    assert stock.bending == pytest.approx(4000 * 0.25**3 / 12)
    assert stock.crease == pytest.approx(stock.bending / 25)
    assert stock.weight == pytest.approx(200e-9 * 9.80665)


@pytest.mark.parametrize("text", ["200gsm 0.3mm", "200 g/m2, 0.3 mm", " 200GSM .3mm ", "200 g/m² 0.3mm"])
def test_thickness_may_stand_beside_the_grammage(text):
    stock = parse_stock(text)
    assert (stock.grammage, stock.thickness) == (200, 0.3)
    assert stock.name == "200gsm 0.3mm"


def test_measured_values_take_the_place_of_defaults():
    stock = parse_stock("200gsm 0.3mm", thickness=0.2, bending=7.0, crease=0.0)
    assert (stock.thickness, stock.bending, stock.crease) == (0.2, 7.0, 0.0)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("", "no stock"),
        ("card", "200gsm"),
        ("A4", "no stock"),
        ("200", "no stock"),
        ("-200gsm", "no stock"),
        ("200gsm 300x400mm", "no stock"),
        ("0gsm", "grammage"),
        ("20000gsm", "grammage"),
        ("9" * 400 + "gsm", "grammage"),
        ("200gsm 0mm", "thickness"),
        ("200gsm 2mm", "kg/m3"),
        ("200gsm 0.05mm", "kg/m3"),
    ],
)
def test_what_is_no_stock_is_refused_in_one_line(text, word):
    with pytest.raises(InputError, match=word) as refused:
        parse_stock(text)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(("key", "value"), [("bending", -1.0), ("crease", float("nan")), ("thickness", 1e300)])
def test_given_values_are_checked(key, value):
    with pytest.raises(InputError, match=key):
        parse_stock("200gsm", **{key: value})


@pytest.mark.parametrize(
    ("text", "grammage", "rest"),
    [
        ("A4", None, "A4"),
        ("Letter 160gsm", 160, "Letter"),
        ("160gsm 0.2mm, Letter landscape", 160, "Letter landscape"),
        ("200gsm 300x400mm", 200, "300x400mm"),
        ("200gsm", 200, ""),
    ],
)
def test_stock_is_taken_out_of_a_description_of_paper(text, grammage, rest):
    stock, left = split_stock(text)
    assert (None if stock is None else stock.grammage) == grammage
    assert left == rest


@pytest.mark.parametrize(("text", "advice"), [("80gsm", "fold"), ("200gsm", "score"), ("500gsm", "perforate")])
def test_thicker_paper_wants_more_preparation_of_its_folds(text, advice):
    assert parse_stock(text).crease_advice == advice


@given(grammage=st.floats(30, 1500), factor=st.floats(0.9, 1.5))
def test_the_name_gives_the_stock_back(grammage, factor):
    stock = Stock.of(round(grammage, 2), thickness=round(factor * grammage / 800, 3))
    again = parse_stock(stock.name)
    assert again.grammage == pytest.approx(stock.grammage, rel=1e-4)
    assert again.thickness == pytest.approx(stock.thickness, rel=1e-4)

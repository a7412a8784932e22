"""Compiled functions find what plain numpy finds, and setting up compiles all of them."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import popsim.fitting
from popsim.fitting.kernels.hinges import crossings, overhangs
from popsim.fitting.kernels.pictures import both_sides, compared, mirrored, paint
from popsim.fitting.kernels.roofs import gains
from popsim.fitting.kernels.stencils import held

DEPTHS = st.one_of(st.just(np.inf), st.floats(1, 9, width=32))
VIEWS = arrays(np.float32, (2, 4, 4), elements=DEPTHS)


def called_functions():
    """Compiled functions that fitting calls; what these call is compiled with them."""
    for path in Path(popsim.fitting.__file__).parent.glob("*.py"):
        for module, name in re.findall(r"from (popsim\.fitting\.kernels\.\w+) import (\w+)", path.read_text()):
            found = getattr(importlib.import_module(module), name)
            if hasattr(found, "signatures"):
                yield found


def test_setting_up_compiles_all_that_is_called():
    importlib.import_module("popsim.fitting.kernels.__main__")
    functions = list(called_functions())
    assert {held, overhangs, paint, gains} <= set(functions)
    assert [own.py_func.__qualname__ for own in functions if not own.signatures] == []


def test_what_is_kept_goes_by_the_text_of_all_it_may_come_from():
    (ending,) = {own.py_func.__qualname__.rsplit("_", 1)[1] for own in called_functions()}
    assert len(ending) == 12 and int(ending, 16) >= 0


@given(VIEWS, VIEWS)
def test_views_are_compared_pixel_by_pixel(own, model):
    with np.errstate(invalid="ignore"):
        apart = np.abs(own.astype(float) - model) / 2.0
    shown, also = np.isfinite(own), np.isfinite(model)
    both = shown & also
    expected = [shown | also, both, both & (apart <= 1), np.where(both, np.minimum(apart, 1), 0)]
    assert compared(own, model, 2.0) == pytest.approx(
        np.stack([part.sum(axis=(1, 2)) for part in expected], axis=1), abs=1e-3
    )


@given(VIEWS)
def test_a_picture_and_its_image_make_both_sides(near):
    """View 0 sees itself in the mirror, left and right exchanged; so does view 1."""
    spans, others = np.array([[0, 0, 4, 0, 4], [1, 0, 4, 0, 4]]), np.array([0, 1])
    image = np.full(near.shape, np.inf, np.float32)
    paint(image, spans, near.ravel())
    assert np.array_equal(image, near)
    paint(image, *mirrored(spans, near.ravel(), others, 4))
    found = np.empty_like(near)
    both_sides(near, np.array([0, 1]), others, found)
    assert np.array_equal(image, found)
    assert np.array_equal(image, np.minimum(near, near[:, :, ::-1]))


@given(arrays(float, (3, 5, 6), elements=st.integers(-3, 3)), st.integers(0, 10**6))
def test_roofs_gain_what_lies_within_them(gain, seed):
    heights = np.array([2, 4, 6])
    reach = np.random.default_rng(seed).integers(0, 6, (4, 3, 6)) * (np.arange(6) < heights[:, None])
    across = np.concatenate([np.zeros((3, 1, 6)), gain.cumsum(axis=1)], axis=1)
    inside = np.arange(5)[:, None] < reach[:, :, None]
    assert np.array_equal(gains(across, reach, heights), np.einsum("xul,thul->xth", gain, inside))


@pytest.mark.parametrize(
    ("first", "second", "found"),
    [
        ([0, 2, 2, 0], [0, 1, 1, 1], [[1, 1, 3]]),
        ([1, 1, 1, 1], [3, 0, 3, 3], [[0, 0, 1], [0, 2, 4]]),
        ([1, 1], [2, 2, 2, 2], [[0, 0, 2]]),
        ([1, 0, 1, 0], [0, 1, 0, 1], []),
    ],
)
def test_where_both_go_on_beyond_a_hinge_one_shows_less(first, second, found):
    counts = np.array(first), np.array(second)
    assert crossings(*counts, 1.0, 1.0, 8.0, 0.5).tolist() == found
    assert crossings(*counts, 1.0, 1.0, 8.0, 9.0).tolist() == []

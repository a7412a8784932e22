"""The orthographic view: axes, half pixels, round trips."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from popsim.errors import GeometryError
from popsim.rendering.view import View

FRONT = {"eye": (0, 0, 1), "up": (0, 1, 0)}


def view(low=(0.0, 0.0), size=(4.0, 3.0), ppu=2.0, eye=(0, 0, 1), up=(0, 1, 0), origin=(0, 0, 0)):
    return View(*(np.asarray(a, dtype=float) for a in (eye, up, origin, low, size)), ppu)


def test_right_is_to_the_right_of_who_looks_from_the_eye():
    np.testing.assert_allclose(view().right, [1, 0, 0])
    np.testing.assert_allclose(view(eye=(1, 0, 0), up=(0, 0, 1)).right, [0, 1, 0])


def test_up_is_made_square_to_the_eye():
    np.testing.assert_allclose(view(up=(0, 2, 5)).up, [0, 1, 0])


def test_half_pixel_convention():
    v = view(low=(10.0, 20.0))
    assert v.shape == (6, 8)
    np.testing.assert_allclose(v.to_pixel([10.0, 23.0]), [0, 0])  # upper-left corner of the image
    np.testing.assert_allclose(v.to_pixel([14.0, 20.0]), [8, 6])
    np.testing.assert_allclose(v.pixel_centres()[0, 0], [10.25, 22.75])
    np.testing.assert_allclose(v.pixel_centres()[-1, -1], [13.75, 20.25])


def test_lower_left_corner_is_exact_when_the_size_is_no_whole_number_of_pixels():
    v = view(size=(4.1, 3.1))
    assert v.shape == (7, 9)
    np.testing.assert_allclose(v.from_pixel([0, 7]), [0, 0])


def test_rounding_noise_adds_no_pixel():
    assert view(size=(0.1 * 3 / 0.3, 1.0), ppu=100.0).shape == (100, 100)


def test_depth_grows_away_from_the_eye():
    v = view(origin=(0, 0, 5))
    np.testing.assert_allclose(v.to_plane([1, 2, 3]), [1, 2, 2])


@given(arrays(float, (4, 3), elements=st.floats(-100, 100)), arrays(float, 3, elements=st.floats(-1, 1)))
def test_round_trips(points, eye):
    if np.linalg.norm(eye) < 0.1 or np.linalg.norm(np.cross(eye, [0.3, 0.9, 0.2])) < 0.05:
        return
    v = view(eye=eye, up=(0.3, 0.9, 0.2), origin=(1, 2, 3), low=(-3, 4), ppu=7.3)
    np.testing.assert_allclose(v.to_space(v.to_plane(points)), points, atol=1e-10)
    plane = v.to_plane(points)[:, :2]
    np.testing.assert_allclose(v.from_pixel(v.to_pixel(plane)), plane, atol=1e-10)


def test_framing_holds_all_points():
    points = np.random.default_rng(1).normal(size=(50, 3))
    v = View.framing(points, eye=(1, 2, 3), up=(0, 0, 1), pixels_per_unit=10, margin=0.5)
    plane = v.to_plane(points)[:, :2]
    np.testing.assert_allclose(plane.min(axis=0) - v.low, 0.5)
    np.testing.assert_allclose(v.low + v.size - plane.max(axis=0), 0.5)


def test_framing_gives_a_pixel_to_what_is_seen_edge_on():
    assert View.framing([[0, 0, 0], [0, 5, 1]], pixels_per_unit=2, **FRONT).shape == (10, 1)


@pytest.mark.parametrize("wrong", [{"up": (0, 0, 2)}, {"size": (0, 1)}, {"ppu": 0.0}, {"eye": (0, 0, 0)}])
def test_refusals(wrong):
    with pytest.raises(GeometryError):
        view(**wrong)

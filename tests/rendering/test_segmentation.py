"""Views fall into the layers that a designer would make of them (Eq. 3)."""

import time

import numpy as np
import pytest
from rendering_surfaces import box, joined

from popsim.errors import GeometryError
from popsim.rendering.maps import render_maps
from popsim.rendering.segmentation import label_map, segment
from popsim.rendering.view import View


def courses(depth, normal, step, turn):
    """Maps and thresholds, as a view has them."""
    return [(depth, step), *((normal[..., k], turn) for k in range(3))]


def front(surface, per_mm=4.0):
    return render_maps(
        surface,
        View.framing(surface.triangles.reshape(-1, 3), eye=(1, 0, 0), up=(0, 0, 1), pixels_per_unit=per_mm),
    )


@pytest.fixture(scope="module")
def steps():
    """Three boxes that step back: grille, windscreen, roof sign."""
    return joined(
        box((0, -20, 0), (50, 20, 15)),
        box((0, -20, 15), (30, 20, 32)),
        box((0, -8, 32), (10, 8, 40)),
    )


def test_each_step_is_a_segment_with_its_depth_and_extent(steps):
    found = segment(front(steps))
    assert len(found.segments) == 3
    for one, (x, low, high) in zip(
        found.segments, [(30, (-20, 15), (20, 32)), (50, (-20, 0), (20, 15)), (10, (-8, 32), (8, 40))], strict=True
    ):
        assert one.depth == pytest.approx(-x, abs=1e-6)
        assert one.low == pytest.approx(low, abs=0.6)
        assert one.high == pytest.approx(high, abs=0.6)
        assert one.area == pytest.approx((high[0] - low[0]) * (high[1] - low[1]), rel=0.05)
        assert one.normal == pytest.approx((1, 0, 0), abs=1e-6)


def test_every_pixel_that_sees_something_belongs_to_a_segment(steps):
    maps = front(steps)
    labels = segment(maps).labels
    assert np.array_equal(labels > 0, maps.mask)


def curved(size=400):
    """A quadratic bowl: depth and normals of one smooth surface."""
    x, y = np.meshgrid(np.linspace(-1, 1, size), np.linspace(-1, 1, size))
    depth = 30 * (x**2 + 0.5 * y**2)
    normal = np.dstack([-60 * x / 200, -30 * y / 200, np.ones_like(x)])
    return depth, (normal / np.linalg.norm(normal, axis=2, keepdims=True)).astype(np.float32)


def test_a_curved_surface_is_one_segment():
    depth, normal = curved()
    labels = label_map(np.ones(depth.shape, bool), courses(depth, normal, 0.5, 0.1), 10)
    assert labels.min() == labels.max() == 1


def test_a_crease_parts_two_slopes_by_their_normals():
    depth, normal = curved()
    depth, normal = (
        np.abs(np.linspace(-40, 40, 400))[None, :] * np.ones((300, 1)),
        np.zeros((300, 400, 3), np.float32),
    )
    normal[:, :200, 0], normal[:, 200:, 0], normal[..., 2] = -0.6, 0.6, 0.8
    labels = label_map(np.ones(depth.shape, bool), courses(depth, normal, 5.0, 0.25), 10)
    assert labels.max() == 2
    assert (labels[:, :198] == labels[0, 0]).all() and (labels[:, 203:] == labels[0, -1]).all()


def test_specks_are_given_to_their_neighbours():
    depth, normal = curved()
    depth[200:203, 200:203] += 20
    labels = label_map(np.ones(depth.shape, bool), courses(depth, normal, 0.5, 0.1), 200)
    assert labels.min() == labels.max() == 1


def test_islands_of_nothing_but_border_stay_without_a_segment():
    mask = np.zeros((50, 50), bool)
    mask[10:40, 10:40] = True
    mask[2, 2] = True
    labels = label_map(mask, courses(np.zeros((50, 50)), np.zeros((50, 50, 3), np.float32), 1.0, 0.2), 10)
    assert labels[2, 2] == 0 and (labels[10:40, 10:40] == 1).all()


def test_two_megapixels_in_half_a_second_of_work():
    depth, normal = curved(1420)
    depth[:, 700:] += 25
    mask = np.ones(depth.shape, bool)
    spent = []
    for _ in range(3):
        start = time.process_time()
        labels = label_map(mask, courses(depth, normal, 1.0, 0.25), 64)
        spent.append(time.process_time() - start)
    assert labels.max() == 2
    assert min(spent) < 0.5


def test_small_parts_given_to_a_segment_move_neither_its_depth_nor_its_extent():
    block, knob = box((0, -20, 0), (50, 20, 15)), box((0, -1, 15), (44, 1, 16.5))
    plain, knobbed = (segment(front(shape)).segments[0] for shape in (block, joined(block, knob)))
    assert (knobbed.nearest, knobbed.depth, knobbed.farthest) == pytest.approx((-50, -50, -50), abs=1e-6)
    assert knobbed.high == pytest.approx(plain.high, abs=0.3)
    assert knobbed.area == pytest.approx(plain.area + 2 * 1.5, abs=0.5)


def test_a_described_view_of_two_megapixels_takes_half_a_second_of_work(steps):
    view = View.framing(
        steps.triangles.reshape(-1, 3), eye=(1, 0, 0), up=(0, 0, 1), pixels_per_unit=(2e6 / 1600) ** 0.5
    )
    maps = render_maps(steps, view)
    assert maps.mask.size == pytest.approx(2e6, rel=0.01)
    spent = []
    for _ in range(3):
        start = time.process_time()
        found = segment(maps)
        spent.append(time.process_time() - start)
    assert len(found.segments) == 3
    assert min(spent) < 0.5


def test_thresholds_must_be_positive(steps):
    with pytest.raises(GeometryError):
        segment(front(steps), step=0)

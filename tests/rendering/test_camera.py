"""Cameras: framing, axes, rays."""

import numpy as np
import pytest

from popsim.errors import GeometryError
from popsim.rendering.camera import Camera

BOUNDS = np.array([[-1.0, -2.0, 0.0], [5.0, 3.0, 7.0]])


def projected(camera, points):
    """Picture coordinates, -1..1 from border to border in height."""
    relative = points - camera.position
    plane = np.stack([relative @ camera.right, relative @ camera.up], -1)
    if camera.perspective:
        plane *= camera.distance / (-relative @ camera.eye)[:, None]
    return plane / (camera.height / 2)


def corners(bounds):
    return np.array(np.meshgrid(*bounds.T)).reshape(3, -1).T


@pytest.mark.parametrize("field", [0.0, 5.0, 28.0, 90.0])
@pytest.mark.parametrize("aspect", [0.5, 4 / 3, 3.0])
@pytest.mark.parametrize("angles", [(0, 0), (35, 25), (-120, 80), (200, -90)])
def test_looking_at_frames_the_box_tightly(field, aspect, angles):
    camera = Camera.looking_at(BOUNDS, *angles, field, aspect=aspect, margin=0.1)
    seen = projected(camera, corners(BOUNDS)) / [aspect, 1.0]
    assert np.abs(seen).max() == pytest.approx(0.8)
    tight = np.abs(seen).max(axis=0) > 0.8 - 1e-9
    np.testing.assert_allclose((seen.max(axis=0) + seen.min(axis=0))[tight], 0, atol=1e-9)


def test_angle_of_view_is_the_one_asked_for():
    camera = Camera.looking_at(BOUNDS, field_of_view_deg=40.0)
    assert 2 * np.arctan(camera.height / 2 / camera.distance) == pytest.approx(np.radians(40))


@pytest.mark.parametrize(("up", "first", "quarter"), [("z", "x", "y"), ("y", "z", "x"), ("x", "y", "z")])
def test_azimuth_turns_right_handed_about_the_up_axis(up, first, quarter):
    axes = dict(zip("xyz", np.eye(3), strict=True))
    np.testing.assert_allclose(Camera.looking_at(BOUNDS, 0, 0, up=up).eye, axes[first], atol=1e-12)
    np.testing.assert_allclose(Camera.looking_at(BOUNDS, 90, 0, up=up).eye, axes[quarter], atol=1e-12)
    np.testing.assert_allclose(Camera.looking_at(BOUNDS, 40, 0, up=up).up, axes[up], atol=1e-12)
    np.testing.assert_allclose(Camera.looking_at(BOUNDS, 40, 90, up=up).eye, axes[up], atol=1e-12)


@pytest.mark.parametrize("perspective", [True, False])
def test_rays_go_through_the_pixels(perspective):
    camera = Camera(np.array([9.0, 2, 3]), np.zeros(3), np.array([0, 0, 1.0]), 4.0, perspective)
    origins, directions = camera.rays(6, 8, slice(None))
    seen = projected(camera, origins + 5.0 * directions).reshape(6, 8, 2)
    np.testing.assert_allclose(seen[0, 0], [-7 / 6, 5 / 6], atol=1e-12)
    np.testing.assert_allclose(seen[5, 7], [7 / 6, -5 / 6], atol=1e-12)
    np.testing.assert_allclose(-directions @ camera.eye, 1)
    np.testing.assert_array_equal(camera.rays(6, 8, slice(10, 20))[1], directions[10:20])


def test_a_point_can_be_framed():
    assert Camera.looking_at(np.zeros((2, 3))).height > 0


@pytest.mark.parametrize("wrong", [{"up": "w"}, {"field_of_view_deg": 180}, {"margin": 0.5}, {"aspect": 0}])
def test_refusals(wrong):
    with pytest.raises(GeometryError):
        Camera.looking_at(BOUNDS, **wrong)


def test_a_camera_that_looks_along_its_up_direction_is_refused():
    with pytest.raises(GeometryError, match="line of sight"):
        Camera(np.array([0, 0, 1.0]), np.zeros(3), np.array([0, 0, 2.0]), 1.0)

import numpy as np
import pytest

from popsim.geometry.directions import across, cone_directions, sphere_directions

AXES = [np.array(axis) / np.linalg.norm(axis) for axis in ([0.0, 0.0, 1.0], [1.0, 2.0, 3.0], [-1.0, -1.0, 0.0])]


@pytest.mark.parametrize("axis", AXES)
def test_directions_across_an_axis_are_at_right_angles(axis):
    frame = np.stack([axis, *across(axis)])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(frame) == pytest.approx(1.0)


def test_directions_fill_the_sphere_evenly():
    found = sphere_directions(400)
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(400))
    # a sphere is the same in all directions: its mean is 0, its second moment a third of the unit matrix
    assert np.abs(found.mean(axis=0)).max() < 0.005
    assert found.T @ found / 400 == pytest.approx(np.eye(3) / 3, abs=0.005)
    nearest = np.sort(found @ found.T, axis=1)[:, -2]
    assert np.arccos(nearest).min() > 0.5 * np.sqrt(4 * np.pi / 400)  # none lie upon each other


@pytest.mark.parametrize("axis", AXES)
def test_directions_of_a_cone_stay_within_it(axis):
    found = cone_directions(axis, 0.1, 64)
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(64))
    assert (found @ axis).min() > np.cos(0.1)
    assert found.mean(axis=0) == pytest.approx(axis, abs=0.01)

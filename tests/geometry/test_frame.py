"""The card frame, rigid motions and arrays at the boundary."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.errors import GeometryError
from popsim.geometry.arrays import locked
from popsim.geometry.frame import OPEN, Side, page_direction, page_poses, skew_point
from popsim.geometry.rigid import Frame, motion_between, transform, translation

THETA = np.radians([180.0, 90.0, 0.0])


def test_open_card_lies_in_the_plane_z_0() -> None:
    assert page_direction(Side.GROUND, THETA)[0] == pytest.approx([0, 1, 0])
    assert page_direction(Side.BACKDROP, THETA)[0] == pytest.approx([0, -1, 0])


def test_closed_pages_meet_in_the_bisecting_plane() -> None:
    for side in Side:
        assert page_direction(side, THETA)[-1] == pytest.approx([0, 0, 1])


@given(theta=st.floats(0, np.pi))
def test_pages_open_by_the_fold_angle(theta: float) -> None:
    ground, backdrop = (page_direction(side, np.array([theta]))[0] for side in Side)
    assert ground @ backdrop == pytest.approx(np.cos(theta), abs=1e-12)
    assert ground[2] == pytest.approx(backdrop[2])


@pytest.mark.parametrize("side", Side)
def test_page_poses_carry_the_open_page_to_its_direction(side: Side) -> None:
    start = page_direction(side, np.array([OPEN]))
    moved = transform(page_poses(side, THETA), start)[:, 0]
    assert moved == pytest.approx(page_direction(side, THETA))
    assert page_poses(side, THETA)[0] == pytest.approx(np.eye(4))


def test_skew_coordinates_do_not_change_while_closing() -> None:
    for side in Side:
        points = skew_point(3, 5, 7, side, THETA)
        back = points - [3, 0, 7]
        assert np.linalg.norm(back, axis=1) == pytest.approx([5, 5, 5])
        assert points[:, 0] == pytest.approx([3, 3, 3])
    assert skew_point(3, 5, 7, Side.BACKDROP, THETA)[0] == pytest.approx([3, -5, 7])


def test_sides_are_opposite() -> None:
    assert Side.GROUND.other is Side.BACKDROP
    assert Side.BACKDROP.other is Side.GROUND


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_motion_between_frames_carries_one_to_the_other(seed: int) -> None:
    rng = np.random.default_rng(seed)
    frames = []
    for count in (1, 4):
        axes = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
        frames.append(Frame(rng.uniform(-9, 9, (count, 3)), axes[:, 0], axes[:, 1]))
    start, goal = frames
    motion = motion_between(start, goal)
    corners = np.concatenate([start.origin, start.origin + start.first, start.origin + start.second])
    moved = transform(motion, corners)
    assert moved[:, 0] == pytest.approx(goal.origin)
    assert moved[:, 1] == pytest.approx(goal.origin + goal.first)
    assert moved[:, 2] == pytest.approx(goal.origin + goal.second)
    assert np.linalg.det(motion[:, :3, :3]) == pytest.approx(np.ones(4))


def test_translation_shifts() -> None:
    assert transform(translation(np.array([1.0, 2, 3])), np.zeros((2, 3))) == pytest.approx(
        np.array([[1, 2, 3]] * 2)
    )


def test_locked_arrays_are_copies_that_cannot_be_written() -> None:
    given_values = np.array([[1, 2, 3]])
    array = locked(given_values, (None, 3), "points")
    given_values[0, 0] = 9
    assert array.dtype == np.float64
    assert array[0, 0] == 1
    with pytest.raises(ValueError, match="read-only"):
        array[0, 0] = 5


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([1.0, 2.0], "points must have shape n x 3, not 2"),
        ([[1.0, 2.0]], "points must have shape n x 3, not 1 x 2"),
        ([[1.0, 2.0, float("nan")]], "points must be finite"),
        ([[1.0, 2.0, float("inf")]], "points must be finite"),
    ],
)
def test_wrong_arrays_are_refused_by_name(values: object, message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        locked(values, (None, 3), "points")

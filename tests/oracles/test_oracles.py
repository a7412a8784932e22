"""The oracles themselves: known answers, and that they can say no."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles.chain import Chain
from oracles.crossing import Face, crossing_depth, crossings, piercing_depth
from oracles.drawing import CARD

from popsim.design import Patch
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.validity import examine
from popsim.verification.random_designs import random_design

SQUARE = ((-10.0, -10.0, 0.0), (10.0, -10.0, 0.0), (10.0, 10.0, 0.0), (-10.0, 10.0, 0.0))


def face(outline, holes=()) -> Face:
    return Face.of(Patch(id="P", outline=tuple(map(tuple, outline)), holes=tuple(holes)))


def upright(low: float, high: float, x: tuple[float, float] = (-3.0, 3.0), y: float = 0.0) -> Face:
    """A rectangle in a plane y = const."""
    return face([(x[0], y, low), (x[1], y, low), (x[1], y, high), (x[0], y, high)])


@pytest.mark.parametrize(
    ("other", "depth"),
    [
        (upright(-2, 5), 2.0),  # 2 above its own edge
        (upright(-2, 5, (8, 20)), 1.0),  # halfway between its own end and the edge of the square
        (upright(0, 5), 0.0),  # stands on the square
        (upright(1, 5), 0.0),  # above it
        (upright(-2, 5, (10, 20)), 0.0),  # touches its edge
        (upright(-2, 5, (11, 20)), 0.0),  # beside it
        (face([(x + 1, y + 1, 0.0) for x, y, _ in SQUARE]), 0.0),  # in its plane
        (face([(x, y, 1e-3) for x, y, _ in SQUARE]), 0.0),  # parallel to it
    ],
)
def test_depth_of_known_crossings(other: Face, depth: float) -> None:
    found = crossing_depth(face(SQUARE), other)
    assert found == pytest.approx(depth, abs=1e-9)
    assert crossing_depth(other, face(SQUARE)) == pytest.approx(found, abs=1e-9)


def test_what_passes_through_a_hole_does_not_cross() -> None:
    hole = ((-4.0, -4.0, 0.0), (4.0, -4.0, 0.0), (4.0, 4.0, 0.0), (-4.0, 4.0, 0.0))
    assert crossing_depth(face(SQUARE, [hole]), upright(-2, 5)) == 0
    assert crossing_depth(face(SQUARE, [hole]), upright(-2, 5, (-8, 8))) > 1


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_crossing_does_not_depend_on_the_frame(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn * np.sign(np.linalg.det(turn)), rng.uniform(-50, 50, 3)
    first, second = face(SQUARE), upright(*sorted(rng.uniform(-8, 8, 2)), tuple(sorted(rng.uniform(-15, 15, 2))))
    moved = crossing_depth(first.moved(pose), second.moved(pose))
    assert moved == pytest.approx(crossing_depth(first, second), abs=1e-6)


def test_fold_that_pierces_a_patch_counts() -> None:
    """Each wing of an upright V touches the plate y = 0 with its fold only."""
    plate = upright(0, 20, (-10, 10))
    left = face([(0, 0, 5), (0, 0, 15), (-6, 6, 15), (-6, 6, 5)])
    right = face([(0, 0, 5), (0, 0, 15), (-6, -6, 15), (-6, -6, 5)])
    axis = np.array([[0.0, 0, 5], [0, 0, 15]])
    assert crossing_depth(plate, left) == crossing_depth(plate, right) == 0
    assert piercing_depth(axis, (left, right), plate) == pytest.approx(10.0)
    assert piercing_depth(axis, (left, left), plate) == 0
    assert piercing_depth(axis + np.array([20.0, 0, 0]), (left, right), plate) == 0


def test_two_boxes_that_overlap_are_seen_where_their_folds_meet() -> None:
    """Front fold at x = w cos a, back fold at 30 - w cos a (Sec. 3.3.2): they meet at cos a = 30 / 2w."""
    boxes = [
        BoxFold.plain(name, card_pair(CARD), 25.0, 30.0, x) for name, x in (("M1", (-40, 0)), ("M2", (30, 60)))
    ]
    design = assemble(CARD, boxes)
    meet = 2 * np.arccos(30 / 50)
    theta = meet + np.radians([2.0, -2.0])
    found = list(crossings(design, examine(design).poses(theta), theta))
    assert {crossing.theta for crossing in found} == {theta[1]}
    assert {crossing.patches for crossing in found} == {("M1.F_L", "M2.B_L"), ("M1.F_R", "M2.B_R")}


def test_free_motions_of_a_box_without_pairs() -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 25.0, 30.0, (-20.0, 20.0))
    bare = BoxFold("M1", box.pair, box.half_width, box.tops, ())
    theta = np.radians([170.0, 90.0, 20.0])
    assert [free for _, _, free in Chain(assemble(CARD, [box])).fold(theta)] == [0, 0, 0]
    assert [free for _, _, free in Chain(assemble(CARD, [bare])).fold(theta)] == [1, 1, 1]


@pytest.mark.parametrize("seed", range(4))
def test_chain_cannot_close_what_does_not_fold(seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 3), breaking="lengths").design
    theta = np.radians([90.0, 30.0, 1.0, 0.0])
    folded = Chain(design).fold(theta)
    closed, gap, _ = folded[-1]
    heights = [
        np.abs((np.array(p.outline) @ closed[p.id][:3, :3].T + closed[p.id][:3, 3])[:, 1]) for p in design.patches
    ]
    assert gap > 0.1 or max(height.max() for height in heights) > 1.0

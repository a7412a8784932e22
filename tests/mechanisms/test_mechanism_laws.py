"""Laws that every mechanism of the registry obeys, on every kind of pair it can stand on."""

import json
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles.drawing import Drawn, draw_mechanism
from shapely import Point

from popsim.errors import DesignError, GeometryError
from popsim.geometry.frame import OPEN
from popsim.geometry.plane import Plane
from popsim.geometry.rigid import transform
from popsim.mechanisms import MECHANISMS, Mechanism, Members, PairKind
from popsim.mechanisms.plate import FIRST_BASE, SECOND_BASE
from popsim.mechanisms.restore import essential, restored
from popsim.verification.random_designs.spoil import spoil

THETA = np.radians([180.0, 179.0, 135.0, 90.0, 45.0, 10.0, 1.0, 0.0])
EXACT = 1e-9
"""mm; closed forms agree up to the rounding of doubles at 200 mm."""

WRITTEN = 1e-8
"""mm; after coordinates have been written with nine decimals."""

every_mechanism = pytest.mark.parametrize("kind", MECHANISMS.values(), ids=MECHANISMS.keys())
seeds = st.integers(0, 2**32 - 1)


def law(test=None, *, examples: int = 8):
    """Run a test on drawn members of each mechanism."""
    if test is None:
        return partial(law, examples=examples)

    @every_mechanism
    @given(seed=seeds)
    @settings(max_examples=examples, deadline=None)
    def check(kind: type[Mechanism], seed: int) -> None:
        test(draw_mechanism(kind, seed))

    check.__name__ = test.__name__
    check.holds_for = test
    return check


@law
def test_plates_are_planar_and_their_roles_are_unique(drawn: Drawn) -> None:
    plates = drawn.mechanism.plates()
    assert len({plate.role for plate in plates}) == len(plates)
    for plate in plates:
        plane = Plane.through(plate.outline)
        assert np.abs(plane.distance(plate.outline)).max() < EXACT
        assert abs(plane.normal @ plate.outward) == pytest.approx(1)
        assert plane.polygon(plate.outline).is_valid


@law
def test_joints_run_along_the_edges_of_their_plates_and_reach_both_base_patches(drawn: Drawn) -> None:
    faces = {plate.role: plate.outline for plate in drawn.mechanism.plates()}
    for joint in drawn.mechanism.joints():
        assert np.linalg.norm(joint.axis[1] - joint.axis[0]) > 0
        for role in set(joint.roles) - {FIRST_BASE, SECOND_BASE}:
            plane = Plane.through(faces[role])
            assert np.abs(plane.distance(joint.axis)).max() < EXACT
            edges = plane.polygon(faces[role]).boundary
            assert all(
                edges.distance(Point(plane.flat(end))) < EXACT for end in (*joint.axis, joint.axis.mean(axis=0))
            )
    stands_on = [role for joint in drawn.mechanism.joints() for role in joint.roles]
    assert {FIRST_BASE, SECOND_BASE} <= set(stands_on)


@law
def test_poses_are_rigid_and_start_open(drawn: Drawn) -> None:
    poses = drawn.mechanism.poses(THETA)
    assert set(poses) == {plate.role for plate in drawn.mechanism.plates()}
    for motion in poses.values():
        assert np.allclose(motion[0], np.eye(4), atol=EXACT)
        turn = motion[:, :3, :3]
        assert np.allclose(turn @ np.swapaxes(turn, 1, 2), np.eye(3), atol=1e-12)
        assert np.allclose(np.linalg.det(turn), 1)


@law
def test_one_angle_at_a_time_gives_the_same_poses(drawn: Drawn) -> None:
    together = drawn.mechanism.poses(THETA)
    for k, theta in enumerate(THETA):
        for role, motion in drawn.mechanism.poses(np.array([theta])).items():
            assert np.allclose(motion[0], together[role][k], atol=1e-12)


@law
def test_joint_ends_coincide_at_every_angle(drawn: Drawn) -> None:
    poses, mechanism = drawn.poses(THETA), drawn.mechanism
    for joint in mechanism.joints():
        first, second = (transform(poses[mechanism.patch_id(role)], joint.axis) for role in joint.roles)
        assert np.abs(first - second).max() < EXACT, joint.roles


@law
def test_closed_pose_lies_in_the_bisecting_plane(drawn: Drawn) -> None:
    assert np.abs(drawn.mechanism.swept(THETA)[-1][:, 1]).max() < EXACT


@law
def test_closing_range_is_what_the_corners_reach(drawn: Drawn) -> None:
    x = drawn.mechanism.swept(np.linspace(OPEN, 0, 181))[..., 0]
    assert drawn.mechanism.closing_range() == pytest.approx((x.min(), x.max()), abs=EXACT)


@law
def test_closed_extent_is_the_height_of_the_closed_pose(drawn: Drawn) -> None:
    closed = drawn.mechanism.swept(np.array([0.0]))[0]
    assert drawn.mechanism.closed_extent() == pytest.approx(closed[:, 2].max(), abs=EXACT)


@law
def test_drawn_member_keeps_to_its_room(drawn: Drawn) -> None:
    low, high = drawn.mechanism.closing_range()
    assert drawn.room.x[0] - EXACT <= low
    assert high <= drawn.room.x[1] + EXACT
    assert drawn.mechanism.closed_extent() <= drawn.room.extent + EXACT


@law
def test_design_gives_the_mechanism_back(drawn: Drawn) -> None:
    mechanism, design = drawn.mechanism, drawn.design
    found = type(mechanism).recognise(Members(design, design.mechanism_by_id[mechanism.id]))
    assert [condition for condition in found.conditions if not condition.holds] == []
    assert found.roles == {mechanism.patch_id(plate.role): plate.role for plate in mechanism.plates()}
    assert found.mechanism is not None
    assert _numbers(found.mechanism.parameters()) == pytest.approx(_numbers(mechanism.parameters()), abs=WRITTEN)
    pair, given = found.mechanism.pair, mechanism.pair
    assert (pair.patches, pair.kind, pair.side, pair.owner) == (given.patches, given.kind, given.side, given.owner)
    assert (pair.u, pair.v) == pytest.approx((given.u, given.v), abs=WRITTEN)


@law
def test_offered_pairs_share_their_fold_line_at_every_angle(drawn: Drawn) -> None:
    poses = drawn.poses(THETA)
    for pair in drawn.mechanism.pairs():
        line = np.array([[x, pair.side.value * pair.u, pair.v] for x in pair.x])
        first, second = (transform(poses[name], line) for name in pair.patches)
        assert np.abs(first - second).max() < EXACT
        assert pair.owner == drawn.mechanism.id
        assert min(pair.reach) > 0


@law
def test_offered_pairs_open_by_the_fold_angle_or_by_half_of_it(drawn: Drawn) -> None:
    poses = drawn.poses(THETA)
    for pair in drawn.mechanism.pairs():
        side = np.array([0.0, float(pair.side.value), 0.0])
        away = (side, -side) if pair.kind is PairKind.OPENING else (side, np.array([0.0, 0.0, 1.0]))
        first, second = (poses[name][:, :3, :3] @ leg for name, leg in zip(pair.patches, away, strict=True))
        opening = np.arccos(np.clip((first * second).sum(axis=1), -1, 1))
        assert opening == pytest.approx(THETA if pair.kind is PairKind.OPENING else THETA / 2, abs=1e-7)


@law(examples=4)
def test_children_on_offered_pairs_hold_at_every_angle(drawn: Drawn) -> None:
    rng = np.random.default_rng(0)
    for pair in drawn.mechanism.pairs():
        for kind in (kind for kind in MECHANISMS.values() if kind.pair_kind is pair.kind):
            child = kind.random(rng, pair, "child", drawn.room.within(*pair.free))
            if child is not None:
                whole = Drawn(child, (*drawn.hosts, drawn.mechanism), drawn.room)
                assert child.id in whole.design.mechanism_by_id
                test_joint_ends_coincide_at_every_angle.holds_for(whole)


@law(examples=6)
def test_faults_break_foldability_and_nothing_else(drawn: Drawn) -> None:
    mechanism, design = drawn.mechanism, drawn.design
    assert mechanism.faults()
    for fault in mechanism.faults():
        spoiled = spoil(design, mechanism, fault, fault.most)
        found = type(mechanism).recognise(Members(spoiled, spoiled.mechanism_by_id[mechanism.id]))
        broken = [condition for condition in found.conditions if not condition.holds]
        assert {condition.aspect for condition in broken} == {"foldable"}


@law
def test_moving_pair_and_room_moves_what_is_drawn(drawn: Drawn) -> None:
    by, pair, room = 64.0, drawn.mechanism.pair, drawn.room
    there = replace(pair, x=(pair.x[0] + by, pair.x[1] + by), free=(pair.free[0] + by, pair.free[1] + by))
    first, second = (
        type(drawn.mechanism).random(np.random.default_rng(3), where, "M", within)
        for where, within in ((pair, room), (there, replace(room, x=(room.x[0] + by, room.x[1] + by))))
    )
    assert (first is None) == (second is None)
    if first is not None and second is not None:
        moved = tuple(x + by for x in first.closing_range())
        assert second.closing_range() == pytest.approx(moved, abs=0.01)


@every_mechanism
def test_wrong_kind_of_pair_is_refused(kind: type[Mechanism]) -> None:
    drawn = draw_mechanism(kind, 1)
    other = next(kind_ for kind_ in MECHANISMS.values() if kind_.pair_kind is not kind.pair_kind)
    wrong = draw_mechanism(other, 1).mechanism.pair
    with pytest.raises(GeometryError, match="stands on"):
        replace(drawn.mechanism, pair=wrong)


def _numbers(value: object) -> list[float]:
    """All numbers of nested parameters, in order."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return [number for item in value for number in _numbers(item)]
    return [float(value)]


@law
def test_a_mechanism_is_what_its_primitive_is_mapped_to(drawn: Drawn) -> None:
    """Apart from what the primitive does not say: end pairs and roofs that were left out."""
    mechanism = drawn.mechanism
    again = list(type(mechanism).from_primitive(mechanism.primitive(), mechanism.pair, mechanism.id))
    assert again
    boxes = [
        np.array([open.min(axis=0), open.max(axis=0)])
        for open in (m.swept(THETA[:1])[0] for m in (mechanism, again[0]))
    ]
    np.testing.assert_allclose(*boxes, atol=EXACT)


@law
def test_a_mechanism_comes_back_from_its_parameters(drawn: Drawn) -> None:
    mechanism = drawn.mechanism
    written = json.loads(json.dumps(mechanism.parameters()))
    assert restored(mechanism.type, written, mechanism.pair, mechanism.id) == mechanism


@law
def test_what_follows_from_other_parameters_may_be_left_out(drawn: Drawn) -> None:
    mechanism = drawn.mechanism
    again = restored(mechanism.type, essential(mechanism), mechanism.pair, mechanism.id)
    assert again == mechanism
    assert set(essential(mechanism)) <= set(mechanism.parameters())


@every_mechanism
def test_parameters_that_cannot_be_are_refused_by_name(kind: type[Mechanism]) -> None:
    mechanism = draw_mechanism(kind, 1).mechanism
    own = mechanism.parameters()
    first = next(iter(own))
    for spoiled, words in (
        ({**own, "colour": 3}, "no parameter 'colour'"),
        ({**own, first: "wide"}, f"parameter '{first}'"),
        ({name: value for name, value in own.items() if name != first}, f"missing: {first}"),
    ):
        with pytest.raises(DesignError, match=words):
            restored(kind.type, spoiled, mechanism.pair, "M1")
    with pytest.raises(DesignError, match="there is no mechanism 'pleat'"):
        restored("pleat", own, mechanism.pair, "M1")

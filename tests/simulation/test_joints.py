"""The forest, how far hinges turn, and the poses that joint angles give."""

import numpy as np
import pytest
from folding_designs import CARD, CARD_PAIR, corners, opening, plain_box, tower, wedges

from popsim.mechanisms import assemble
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.simulation import fold_design
from popsim.simulation.contact import contacts_of, searched_frames
from popsim.simulation.extents import reopening
from popsim.simulation.folding import PASSED
from popsim.simulation.forest import PAGES, spanning_forest
from popsim.simulation.kinematics import chain_poses
from popsim.simulation.passing import find_passing, passing_depths
from popsim.simulation.rig import Rig, page_quaternions
from popsim.simulation.solver import BRISK
from popsim.simulation.turning import Turn, free_turn, turned


@pytest.mark.parametrize("design", [plain_box(), tower()[0], wedges()[0]], ids=["box", "tower", "wedges"])
def test_the_forest_spans_all_patches_and_keeps_every_hinge(design):
    forest = spanning_forest(design)
    assert sorted(joint.child for joint in forest.joints) == sorted(patch.id for patch in design.popup_patches)
    kept = {joint.hinge.id for joint in forest.joints} | {hinge.id for hinge in forest.loops}
    assert kept == {hinge.id for hinge in design.hinges if hinge.kind != "central"}
    known = set(PAGES)
    for joint in forest.joints:
        assert joint.parent in known
        known.add(joint.child)


def test_flat_creases_are_joints():
    assert all(hinge.crease is None for hinge in spanning_forest(wedges()[0]).loops)


def test_guarded_hinges_are_joints():
    design = plain_box()
    loop = spanning_forest(design).loops[0].id
    assert loop not in {hinge.id for hinge in spanning_forest(design, frozenset([loop])).loops}


def test_poses_of_joint_angles_are_those_of_mujoco():
    rig = Rig(wedges()[0], BRISK)
    for theta in np.linspace(np.pi, 0.7, 80):
        rig.hold(page_quaternions(np.array(theta)))
        rig.step()
    own = chain_poses(rig, np.array([theta]), rig.state()[None, rig.joint_order])[0]
    mujoco = rig.poses()
    assert own[..., :3, :3] == pytest.approx(mujoco[..., :3, :3], abs=1e-12)
    assert own == pytest.approx(mujoco, abs=1e-9)


def test_a_wall_turns_from_page_to_page():
    """L stands upright on G, which reaches to both sides of it; F_L and F_R lie flat and close to either side."""
    box = plain_box()
    by_pair = {frozenset(hinge.patches): free_turn(box, hinge) for hinge in box.hinges}
    wall, front = by_pair[frozenset(("G", "M.L"))], by_pair[frozenset(("M.F_L", "M.F_R"))]
    assert np.degrees([wall.lower, wall.upper]) == pytest.approx([-90, 90])
    assert np.degrees([front.lower, front.upper]) == pytest.approx([-180, 180])


def test_turning_is_followed_through_the_sweep():
    """The front crease folds by 180 degrees, the wall on the ground by 90 (Sec. 3.2.4)."""
    sweep = fold_design(plain_box(), 30).sweep
    by_pair = {frozenset(hinge.patches): hinge for hinge in sweep.design.hinges}
    for pair, degrees in ((("M.F_L", "M.F_R"), 180), (("G", "M.L"), 90)):
        hinge = by_pair[frozenset(pair)]
        angle = turned(hinge, *(sweep.poses[:, sweep.index[name]] for name in hinge.patches))
        assert abs(np.degrees(angle[sweep.closed])) == pytest.approx(degrees, abs=0.1)
        assert np.degrees(angle[-1]) == pytest.approx(0, abs=0.1)


def test_patches_that_turn_through_each_other_are_found():
    folding = fold_design(plain_box(), 90)
    hinge = next(h for h in folding.sweep.design.hinges if set(h.patches) == {"G", "M.L"})
    narrow = Turn(hinge, np.radians(-45), np.radians(45))
    frames = searched_frames(folding.sweep, 0.05)
    (contact,) = contacts_of(folding.sweep, find_passing(folding.sweep, frames, [narrow], 0.05))
    assert set(contact.patches) == {"G", "M.L"}
    assert np.degrees(contact.first) == pytest.approx(90, abs=2.1)
    assert contact.depth == pytest.approx(40 * np.sin(np.radians(44)), abs=1)


@pytest.mark.parametrize("height", [30, 29.5])
def test_a_step_as_high_as_its_wall_opens_to_where_it_was(height):
    """Closed, its parallelogram could open crosswise, and nothing but its own fold keeps it from that."""
    low = BoxFold.plain("low", CARD_PAIR, 40, 30, (-50, 50))
    high = BoxFold.plain("high", opening(low), 20, 30, (-20, 20))
    step = StepFold("step", corners(high)[0], (-3, 3), 5, height)
    folding = fold_design(assemble(CARD, [low, high, step]), 60)
    assert reopening(folding.sweep).value < 0.01
    assert passing_depths(folding.sweep, list(folding.rig.turns.values())).max() <= PASSED

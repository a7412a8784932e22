"""Free motions with the pages held, at first order and by pushing."""

import numpy as np
import pytest
from folding_designs import (
    CARD,
    CARD_PAIR,
    layered,
    plain_box,
    scaled,
    shearing_box,
    tower,
    wedges,
    without,
)

from popsim.mechanisms import assemble
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation import fold_design
from popsim.simulation.stability import free_motions, push_test


def measured(design):
    folding = fold_design(design, 90)
    rig, sweep = folding.rig, folding.sweep
    return free_motions(rig, sweep, folding.gaps.by_angle < 1e-3), push_test(rig, sweep, 5e-3 * rig.scale)


@pytest.mark.parametrize("design", [tower()[0], wedges()[0], layered()[0]], ids=["tower", "wedges", "layered"])
def test_sound_designs_stand(design):
    motions, pushes = measured(design)
    assert len(motions) == 13
    assert max(motion.count for motion in motions) == 0
    assert min(motion.stiffness for motion in motions) > 1e-3
    assert max(push.moved for push in pushes) < 0.05


def test_a_box_without_end_pairs_shears_at_every_angle():
    motions, pushes = measured(shearing_box())
    assert [motion.count for motion in motions] == [1] * 13
    assert sorted(push.moved for push in pushes)[1] > 0.3
    assert max(push.left for push in pushes) > 0.5


def test_a_patch_on_one_hinge_swings():
    tent = assemble(CARD, [TentFold("T", CARD_PAIR, (-20, 20), 20, 20)])
    motions, pushes = measured(without(tent, {"T.T_4"}))
    assert {motion.count for motion in motions} == {1}
    assert max(push.moved for push in pushes) > 1


@pytest.mark.parametrize("factor", [0.1, 10])
def test_the_count_does_not_depend_on_size(factor):
    for design in (plain_box(), shearing_box()):
        small, large = measured(design)[0], measured(scaled(design, factor))[0]
        assert [motion.count for motion in small] == [motion.count for motion in large]
        if not small[0].count:
            stiffness = [[motion.stiffness for motion in motions] for motions in (small, large)]
            assert np.allclose(*stiffness, rtol=1e-3)


def test_a_small_mechanism_on_a_large_card_is_judged_like_a_large_one():
    small = measured(plain_box(2, 3, (-2, 2)))[0]
    assert min(motion.stiffness for motion in small) > 1e-2

"""RANSAC finds the prisms whose points it is given, and combines them as nothing else would be better."""

from itertools import combinations, pairwise

import numpy as np
import pytest
from fitting_surfaces import block, subject_of, surface
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.design import Card
from popsim.errors import InputError
from popsim.fitting.candidate import Candidate
from popsim.fitting.combination import Combiner, Plan, _apart
from popsim.fitting.ransac import Weights, fitted_prisms
from popsim.mechanisms import PairKind, PrismRow, RectangularPrism, TriangularPrism, card_pair

CARD = Card(x=(-1000, 1000), depth=1000)
PAIR = card_pair(CARD)
EMPTY = Candidate(CARD, least=3.0)


def rng():
    return np.random.default_rng(5)


def box_points(low=(-50, -30, 0), high=(50, 30, 40), count=900):
    """Points on the faces of a box that are seen."""
    points = rng().uniform(low, high, (count, 3))
    face = np.arange(count) % 5
    for axis, end, which in ((0, low, 0), (0, high, 1), (1, low, 2), (1, high, 3), (2, high, 4)):
        points[face == which, axis] = end[axis]
    return points


def roof_points(count=900):
    points = rng().uniform((-50, -30, 0), (50, 30, 1), (count, 3))
    points[:, 2] = 36 * (1 - np.abs(points[:, 1]) / 30)
    return points


def wedge_points(count=900):
    """Both walls of a wedge with its tip at x = 30, 40 mm deep."""
    points = rng().uniform((-10, -1, 0), (30, 1, 50), (count, 3))
    points[:, 1] = np.sign(points[:, 1]) * (30 - points[:, 0])
    return points


def test_a_box_is_found_from_two_points():
    best = fitted_prisms(box_points(), PAIR, Weights(), rng(), 1)[0]
    assert isinstance(best.primitive, PrismRow)
    ((x0, x1, height),) = best.primitive.tops
    assert [x0, x1, height, best.primitive.half_width] == pytest.approx([-50, 50, 40, 30], abs=2.0)
    assert best.consensus.mean() > 0.95 and best.error < 0.05


def test_a_roof_is_found_from_four_points():
    best = fitted_prisms(roof_points(), PAIR, Weights(), rng(), 1)[0]
    assert isinstance(best.primitive, TriangularPrism) and best.primitive.edges == "x"
    assert best.primitive.high == pytest.approx((50, 30, 36), abs=3.0)


def test_a_wedge_is_found_facing_its_tip():
    best = fitted_prisms(wedge_points(), PAIR, Weights(), rng(), 1)[0]
    assert isinstance(best.primitive, TriangularPrism)
    assert (best.primitive.edges, best.primitive.facing) == ("z", 1)
    assert best.primitive.high[0] == pytest.approx(30, abs=2.0)


def test_a_prism_in_a_corner_stands_beside_the_wall():
    points = box_points((-20, 31, 0), (20, 45, 20))
    combined = Combiner(np.concatenate([box_points(), points]), Weights(), 0.001, rng()).combined(EMPTY)
    corners = [node for node in combined.nodes if node.pair.kind is PairKind.CORNER]
    assert corners and isinstance(corners[0].primitive, RectangularPrism)
    assert corners[0].primitive.high == pytest.approx((20, 45, 20), abs=3.0)


@pytest.mark.parametrize("values", [(0.5, 0.5, 0.5), (1.2, -0.1, -0.1), (0.2, 0.2, 0.2)])
def test_weights_add_up_to_one(values):
    with pytest.raises(InputError, match="add up to 1"):
        Weights(*values)


def test_more_weight_on_coverage_favours_larger_volumes():
    both = np.concatenate([box_points(), box_points((-50, -5, 40), (-40, 5, 90), 200)])

    def volume(weights):
        row = next(
            found.primitive
            for found in fitted_prisms(both, PAIR, weights, rng(), 30)
            if isinstance(found.primitive, PrismRow)
        )
        ((x0, x1, height),) = row.tops
        return (x1 - x0) * row.half_width * height

    assert volume(Weights(0.1, 0.1, 0.8)) > 1.5 * volume(Weights(0.8, 0.1, 0.1))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_no_other_choice_of_plans_that_keep_apart_saves_more(seed):
    drawn = np.random.default_rng(seed)
    starts = drawn.integers(0, 20, 7)
    ranges = [(float(a), float(a + n)) for a, n in zip(starts, drawn.integers(1, 9, 7), strict=True)]
    plans = [Plan(PrismRow(5.0, 0.0, ((0.0, 9.0, 9.0),)), PAIR, float(s)) for s in drawn.normal(1, 2, 7)]
    best = 0.0
    for count in range(1, 8):
        for chosen in combinations(range(7), count):
            line = sorted(ranges[k] for k in chosen)
            if all(a[1] <= b[0] for a, b in pairwise(line)):
                best = max(best, sum(plans[k].saving for k in chosen))
    found = _apart(list(zip(plans, ranges, strict=True)))
    assert sum(plan.saving for plan in found) == pytest.approx(best)


def test_tiers_stand_on_each_other_and_keep_all_conditions():
    subject = subject_of(surface(block((-60, -40, 0), (60, 40, 30)), block((-25, -20, 30), (25, 20, 60))))
    found = Combiner(subject.points, Weights(), 0.001, rng()).combined(EMPTY)
    assert found.holds()
    assert [node.parent for node in found.nodes][:2] == [None, 0]
    tall = max(mechanism.face_box()[1, 2] for mechanism in found.mechanisms)
    assert tall == pytest.approx(60, abs=3.0)


def test_points_over_no_pair_leave_the_card_empty():
    assert Combiner(box_points()[:5], Weights(), 0.001, rng()).combined(EMPTY).nodes == ()

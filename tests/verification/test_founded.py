"""What the theory says of other aspects counts for nothing where it refuses that the mechanisms fold."""

import pytest
from folding_designs import slanted_box

from popsim.verification import Settings, verify


@pytest.mark.parametrize("limits", [{"crossing": -1.0}, {"pushed": 0.0}, {"protruding": -1.0}])
def test_no_hole_elsewhere_where_the_theory_refuses_the_folding_itself(limits):
    """Limits that nothing meets make the simulation refuse an aspect that the theory passes."""
    verdict = verify(slanted_box(1), Settings(**limits))
    assert verdict.finding("foldable").theory is False
    refused = [f for f in verdict.findings if f.theory and f.simulation is False]
    assert refused
    assert verdict.holes == ()
    assert not verdict.passed


def test_the_same_limit_makes_a_hole_where_the_theory_stands():
    """Negative control."""
    verdict = verify(slanted_box(0), Settings(crossing=-1.0))
    assert verdict.holes == ("clear",)

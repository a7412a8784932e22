"""Numbers of corners that are the same point."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from popsim.geometry.weld import corner_numbers


@given(
    arrays(
        float,
        st.tuples(st.integers(0, 8), st.just(3), st.just(3)),
        elements=st.sampled_from([-0.0, 0.0, 1.0, 2.5]),
    )
)
def test_same_number_if_and_only_if_same_point(triangles):
    number = corner_numbers(triangles)
    points = triangles.reshape(-1, 3)
    same = (points[:, None] == points[None]).all(axis=2)
    np.testing.assert_array_equal(number.ravel()[:, None] == number.ravel()[None], same)
    assert set(number.ravel()) == set(range(number.max(initial=-1) + 1))

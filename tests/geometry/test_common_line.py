"""The line that two planes share."""

import numpy as np
import pytest

from popsim.errors import GeometryError
from popsim.geometry.plane import Plane, common_line

ORIGIN = np.zeros(3)


def test_it_lies_in_both_planes() -> None:
    one = Plane.facing(np.array([0.6, 0.0, 0.8]), np.array([1.0, 2.0, 3.0]))
    other = Plane.facing(np.array([0.0, 1.0, 0.0]), np.array([-4.0, 5.0, 6.0]))
    line = common_line(one, other)
    assert np.linalg.norm(line[1] - line[0]) == pytest.approx(1)
    for plane in (one, other):
        assert plane.distance(line) == pytest.approx(0, abs=1e-12)


def test_parallel_planes_have_none() -> None:
    up = np.array([0.0, 0.0, 1.0])
    with pytest.raises(GeometryError, match="parallel"):
        common_line(Plane.facing(up, ORIGIN), Plane.facing(-up, up))
